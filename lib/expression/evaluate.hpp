#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/requires.hpp"
#include "expression/domains.hpp"
#include "expression/program.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// The value of a condition.
struct ConditionValue {
  Truth value = Truth::undecided;
  bool total = true;  ///< false if it is undecided and perhaps undefined
};

/// The value of a node that is a condition, from the values of the nodes that it refers to.
template <class Node, class T>
[[nodiscard]] ConditionValue condition_of(const Node& node, const std::vector<T>& numbers,
                                          const std::vector<ConditionValue>& truths) {
  // A condition that is decided stays so whatever part of it is undefined.
  const auto made = [](Truth value, bool total) {
    return ConditionValue{value, total || value != Truth::undecided};
  };
  const auto both = [&](Truth value) { return made(value, truths[node.a].total && truths[node.b].total); };
  const auto is_total = [](const T& number) {
    if constexpr (requires { number.total; }) return number.total;
    return true;
  };
  switch (node.op) {
    case Operator::logical_and:
      return both(truth_and(truths[node.a].value, truths[node.b].value));
    case Operator::logical_or:
      return both(truth_or(truths[node.a].value, truths[node.b].value));
    case Operator::logical_not:
      return {!truths[node.a].value, truths[node.a].total};
    case Operator::literal_true:
      return {Truth::yes, true};
    case Operator::literal_false:
      return {Truth::no, true};
    case Operator::literal_undecided:
      return {Truth::undecided, true};
    default:
      break;
  }
  const T& a = numbers[node.a];
  const T& b = numbers[node.b];
  return made(compare(node.op, a, b), is_total(a) && is_total(b));
}

/// Runs a program over any number type T ("abstract domain"). T must provide, found by argument-dependent
/// lookup: `T from_rational(const T* tag, const Rational&)`, `T apply(Operator, const T&)` for the unary
/// functions, `T apply(Operator, const T&, const T&)` for the binary ones, `Truth compare(Operator, const T&,
/// const T&)` and `T select(Truth, const T&, const T&)` for `if`. `double`, `Interval` and `RationalInterval`
/// do.
///
/// If T has a member `bool total`, an `if` whose condition may be undefined somewhere is not total, although
/// a condition that is merely undecided leaves it so.
///
/// One evaluator holds the scratch memory; use one a thread.
template <class T>
class Evaluator {
 public:
  /// @pre unchecked: `program` outlives the evaluator.
  explicit Evaluator(const Program& program)
      : program_(&program), numbers_(program.nodes.size()), truths_(program.nodes.size()) {
    constants_.reserve(program.constants.size());
    for (const Rational& q : program.constants) {
      constants_.push_back(from_rational(static_cast<const T*>(nullptr), q));
    }
  }

  /// @pre the program is a number; `slots` has a value for every variable
  [[nodiscard]] const T& number(std::span<const T> slots) {
    REQUIRES(!program_->is_condition());
    run(slots);
    return numbers_.back();
  }
  /// @pre the program is a condition; `slots` has a value for every variable
  [[nodiscard]] Truth condition(std::span<const T> slots) {
    REQUIRES(program_->is_condition());
    run(slots);
    return truths_.back().value;
  }
  /// The value of a node in the last run. @pre the node is a number
  [[nodiscard]] const T& at(std::uint32_t node) const {
    REQUIRES(!is_condition(program_->nodes[node].op));
    return numbers_[node];
  }
  /// Truth of a node that is a condition, in the last run.
  [[nodiscard]] Truth truth_at(std::uint32_t node) const { return truths_[node].value; }

 private:
  void run(std::span<const T> slots) {
    const auto& nodes = program_->nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (is_condition(nodes[i].op)) {
        truths_[i] = condition_of(nodes[i], numbers_, truths_);
      } else {
        number_of(nodes[i], slots, numbers_[i]);
      }
    }
  }

  void number_of(const Program::Node& node, std::span<const T> slots, T& result) const {
    switch (node.op) {
      case Operator::constant:
        result = constants_[node.a];
        return;
      case Operator::variable:
        REQUIRES(node.a < slots.size());
        result = slots[node.a];
        return;
      case Operator::if_else:
        choose(node, result);
        return;
      default:
        break;
    }
    if (is_unary_function(node.op)) {
      result = apply(node.op, numbers_[node.a]);
    } else {
      result = apply(node.op, numbers_[node.a], numbers_[node.b]);
    }
  }

  void choose(const Program::Node& node, T& result) const {
    const ConditionValue& condition = truths_[node.a];
    result = select(condition.value, numbers_[node.b], numbers_[node.c]);
    if constexpr (requires { result.total = false; }) {
      if (!condition.total) result.total = false;
    }
  }

  const Program* program_;
  std::vector<T> constants_;
  std::vector<T> numbers_;
  std::vector<ConditionValue> truths_;
};

}  // namespace coordreq

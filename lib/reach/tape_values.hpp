#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "reach/flow_tape.hpp"
#include "reach/upward_apply.hpp"

namespace coordreq {

/// The result of a choice of a FlowTape over some box.
struct Choice {
  enum class Kind : std::uint8_t {
    first,          ///< p; of an angle: itself
    second,         ///< q
    first_negated,  ///< -p
    pinned,         ///< the constant `value`: a discontinuity that the box does not decide, a sign or a floor
    undecided,      ///< a kink of abs, min or max
  };
  Kind kind = Kind::undecided;
  Interval value;
};
/// One a node of the tape; entries of other nodes mean nothing.
using Choices = std::vector<Choice>;

/// Values of all nodes of a tape in an evaluation domain T, `Interval` or `Dual`. Scratch memory: use one a
/// thread. @pre unchecked: the tape outlives it.
template <class T>
class TapeValues {
 public:
  explicit TapeValues(const FlowTape& tape)
      : tape_(&tape), numbers_(tape.nodes.size()), truths_(tape.nodes.size()) {
    for (const Rational& q : tape.constants)
      constants_.push_back(from_rational(static_cast<const T*>(nullptr), q));
  }

  /// Evaluates what does not move; first after a change of the other slots.
  void run_fixed(std::span<const T> slots) { run(tape_->fixed_values, slots, nullptr); }

  /// Evaluates what moves.
  void run_moving(std::span<const T> slots) { run(tape_->values, slots, nullptr); }

  /// Evaluates some of the tape's nodes, in its order, with what they need. @param pins nodes pinned there
  /// have the value given there; null: none
  void run(std::span<const std::uint32_t> nodes, std::span<const T> slots, const Choices* pins) {
    rounded_upward([&] {
      for (const std::uint32_t i : nodes) {
        if constexpr (std::same_as<T, Interval>) {
          if (pins != nullptr && tape_->nodes[i].is_choice() && (*pins)[i].kind == Choice::Kind::pinned) {
            numbers_[i] = (*pins)[i].value;
            continue;
          }
        }
        run_node(i, slots);
      }
    });
  }

  [[nodiscard]] const T& operator[](std::uint32_t node) const { return numbers_[node]; }
  [[nodiscard]] Truth truth(std::uint32_t node) const { return truths_[node].value; }

 private:
  void run_node(std::uint32_t i, std::span<const T> slots) {
    const FlowTape::Node& node = tape_->nodes[i];
    if (is_condition(node.op)) {
      truths_[i] = condition_of(node, numbers_, truths_);
    } else if (node.op == Operator::variable) {
      numbers_[i] = slots[node.a];
    } else if (node.op == Operator::constant) {
      numbers_[i] = constants_[node.a];
    } else if (node.op == Operator::if_else) {
      numbers_[i] = select(truths_[node.a].value, numbers_[node.b], numbers_[node.c]);
      if (!truths_[node.a].total) numbers_[i].total = false;
    } else if (is_unary_function(node.op)) {
      numbers_[i] = apply_upward(node.op, numbers_[node.a]);
    } else {
      numbers_[i] = apply_upward(node.op, numbers_[node.a], numbers_[node.b]);
    }
  }

  const FlowTape* tape_;
  std::vector<T> constants_;
  std::vector<T> numbers_;
  std::vector<ConditionValue> truths_;
};

/// Decides the choices by the values over a box. Discontinuities that stay open are pinned to the middle
/// of their range.
/// @returns whether no kink was left undecided
bool decide(const FlowTape& tape, const TapeValues<Interval>& values, Choices& choices);

/// As decide(), but leaves discontinuities as they are in `choices`.
bool decide_kinks(const FlowTape& tape, const TapeValues<Interval>& values, Choices& choices);

}  // namespace coordreq

#include "expression/truth_table.hpp"

#include <map>
#include <tuple>

#include "expression/functions.hpp"
#include "expression/tape_builder.hpp"

namespace coordreq {
namespace {

using Join = ConditionAtoms::Join;

constexpr std::size_t kMostJoins = 64;

Operator mirrored(Operator op) {
  switch (op) {
    case Operator::less:
      return Operator::greater;
    case Operator::less_equal:
      return Operator::greater_equal;
    case Operator::greater:
      return Operator::less;
    case Operator::greater_equal:
      return Operator::less_equal;
    default:
      return op;
  }
}

Operator negation(Operator op) {
  switch (op) {
    case Operator::less:
      return Operator::greater_equal;
    case Operator::less_equal:
      return Operator::greater;
    case Operator::greater:
      return Operator::less_equal;
    case Operator::greater_equal:
      return Operator::less;
    case Operator::equal:
      return Operator::not_equal;
    default:
      return Operator::equal;
  }
}

/// Whether an operation is defined for all numbers. `if` is not looked into.
bool is_total_operation(Operator op) {
  if (is_number_function(op)) return number_function(op).is_defined_everywhere();
  return op == Operator::constant || op == Operator::variable;
}

class Finder {
 public:
  explicit Finder(const Program& condition) : condition_(condition) {
    for (const Program::Node& node : condition.nodes) {
      total_.push_back(is_total(node));
      copies_.push_back(tape_.copy(condition, node, copies_));
    }
  }

  std::optional<ConditionAtoms> find(bool negated) {
    const auto result = visit(static_cast<std::uint32_t>(condition_.nodes.size() - 1), negated);
    if (!result || found_.atoms.size() < 2) return std::nullopt;
    return std::move(found_);
  }

 private:
  using Index = std::optional<std::uint32_t>;

  [[nodiscard]] bool is_total(const Program::Node& node) const {
    if (!is_total_operation(node.op)) return false;
    const std::size_t operands = operand_count(node.op);
    return (operands < 1 || total_[node.a]) && (operands < 2 || total_[node.b]);
  }

  Index add(Join join, std::uint32_t a = 0, std::uint32_t b = 0) {
    if (found_.nodes.size() >= kMostJoins) return std::nullopt;
    found_.nodes.push_back({join, a, b});
    return static_cast<std::uint32_t>(found_.nodes.size() - 1);
  }

  Index join(bool both, Index a, Index b) {
    if (!a || !b) return std::nullopt;
    return add(both ? Join::both : Join::either, *a, *b);
  }

  Index visit(std::uint32_t i, bool negated) {
    const Program::Node& node = condition_.nodes[i];
    switch (node.op) {
      case Operator::literal_true:
      case Operator::literal_false:
        return add((node.op == Operator::literal_true) != negated ? Join::always : Join::never);
      case Operator::literal_undecided:
        return add(Join::never);  // neither it nor its negation is ever proven
      case Operator::logical_not:
        return visit(node.a, !negated);
      case Operator::logical_and:
      case Operator::logical_or: {
        const Index a = visit(node.a, negated);
        if (!a) return std::nullopt;  // so that a large condition is given up soon
        return join((node.op == Operator::logical_and) != negated, a, visit(node.b, negated));
      }
      default:
        return compare(node.a, negated ? negation(node.op) : node.op, node.b);
    }
  }

  /// a op b
  Index compare(std::uint32_t a, Operator op, std::uint32_t b) {
    const Operator of_a = condition_.nodes[a].op;
    const Operator of_b = condition_.nodes[b].op;
    const bool is_order = op != Operator::equal && op != Operator::not_equal;
    if (is_order && total_[a] && total_[b]) {
      if (of_a == Operator::minimum || of_a == Operator::maximum) return split(a, op, b);
      if (of_b == Operator::minimum || of_b == Operator::maximum) return split(b, mirrored(op), a);
    }
    const auto program = tape_.extract(tape_.apply(op, copies_[a], copies_[b]));
    if (program.nodes.back().op == Operator::literal_true) return add(Join::always);
    if (program.nodes.back().op == Operator::literal_false) return add(Join::never);
    const auto known = atoms_.find({a, op, b});
    const auto number = static_cast<std::uint32_t>(found_.atoms.size());
    if (known == atoms_.end()) found_.atoms.push_back(program);
    return add(Join::atom, atoms_.try_emplace({a, op, b}, number).first->second);
  }

  /// min(p, q) op b or max(p, q) op b
  Index split(std::uint32_t a, Operator op, std::uint32_t b) {
    const Program::Node& node = condition_.nodes[a];
    const bool is_above = op == Operator::greater || op == Operator::greater_equal;
    const Index first = compare(node.a, op, b);
    if (!first) return std::nullopt;
    return join((node.op == Operator::minimum) == is_above, first, compare(node.b, op, b));
  }

  const Program& condition_;
  TapeBuilder tape_;
  std::vector<bool> total_;
  std::vector<TapeBuilder::Index> copies_;
  std::map<std::tuple<std::uint32_t, Operator, std::uint32_t>, std::uint32_t> atoms_;
  ConditionAtoms found_;
};

}  // namespace

std::optional<ConditionAtoms> find_atoms(const Program& condition, bool negated) {
  return Finder(condition).find(negated);
}

}  // namespace coordreq

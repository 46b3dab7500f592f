#include "spec/state_bounds.hpp"

#include <cstdint>
#include <optional>

namespace coordreq {
namespace {

/// The value of a node that is a constant, or its negative.
std::optional<Rational> constant_of(const Program& program, std::uint32_t node) {
  const Program::Node& operation = program.nodes[node];
  if (operation.op == Operator::constant) return program.constants[operation.a];
  if (operation.op != Operator::negate) return std::nullopt;
  const std::optional<Rational> value = constant_of(program, operation.a);
  return value ? std::optional(Rational(-*value)) : std::nullopt;
}

std::optional<StateBound> bound_of(const Program& program, const Program::Node& node, std::size_t states) {
  const bool is_less = node.op == Operator::less || node.op == Operator::less_equal;
  if (!is_less && node.op != Operator::greater && node.op != Operator::greater_equal) return std::nullopt;
  for (const bool is_first : {true, false}) {
    const Program::Node& variable = program.nodes[is_first ? node.a : node.b];
    if (variable.op != Operator::variable || variable.a >= states) continue;
    if (const std::optional<Rational> value = constant_of(program, is_first ? node.b : node.a))
      return StateBound{variable.a, *value, is_less == is_first};
  }
  return std::nullopt;
}

void add_bounds(const Program& program, std::uint32_t node, std::size_t states,
                std::vector<StateBound>& bounds) {
  const Program::Node& operation = program.nodes[node];
  if (operation.op == Operator::logical_and) {
    add_bounds(program, operation.a, states, bounds);
    add_bounds(program, operation.b, states, bounds);
  } else if (const std::optional<StateBound> bound = bound_of(program, operation, states)) {
    bounds.push_back(*bound);
  }
}

}  // namespace

std::vector<StateBound> state_bounds(const Program& condition, std::size_t states) {
  std::vector<StateBound> bounds;
  if (condition.is_condition())
    add_bounds(condition, static_cast<std::uint32_t>(condition.nodes.size() - 1), states, bounds);
  return bounds;
}

}  // namespace coordreq

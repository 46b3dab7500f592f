#include "expression/undefined_reason.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/requires.hpp"
#include "expression/evaluate.hpp"
#include "expression/functions.hpp"

namespace coordreq {
namespace {

std::string range_text(const Interval& a) {
  if (a.is_point()) return fmt::format("{:.6g}", a.lower);
  return fmt::format("a number in [{:.6g}, {:.6g}]", a.lower, a.upper);
}

std::string reason_at(const Program::Node& node, const Evaluator<Interval>& values) {
  const NumberFunction& function = number_function(node.op);
  const std::string a = range_text(values.at(node.a));
  if (is_unary_function(node.op)) return fmt::format(fmt::runtime(function.undefined), a);
  return fmt::format(fmt::runtime(function.undefined), a, range_text(values.at(node.b)));
}

bool is_zero(const Program& program, std::uint32_t i) {
  return program.nodes[i].op == Operator::constant && program.constants[program.nodes[i].a] == 0;
}

/// `if(first <= x and x <= last, x, 0/0)`: x is the argument of a table that refuses others.
bool is_argument_of_table(const Program& program, const Program::Node& node) {
  if (node.op != Operator::if_else || program.nodes[node.a].op != Operator::logical_and) return false;
  const Program::Node& nothing = program.nodes[node.c];
  return nothing.op == Operator::divide && is_zero(program, nothing.a) && is_zero(program, nothing.b);
}

std::string reason_of_table(const Program& program, const Program::Node& node,
                            const Evaluator<Interval>& values) {
  const Program::Node& inside = program.nodes[node.a];
  return fmt::format("a table from {} to {} at {}", range_text(values.at(program.nodes[inside.a].a)),
                     range_text(values.at(program.nodes[inside.b].b)), range_text(values.at(node.b)));
}

/// Operands that can be the reason why the result of a node is undefined, last first.
std::vector<std::uint32_t> operands(const Program::Node& node, const Evaluator<Interval>& values) {
  if (node.op == Operator::if_else) {
    if (values.truth_at(node.a) == Truth::yes) return {node.b, node.a};
    if (values.truth_at(node.a) == Truth::no) return {node.c, node.a};
    return {node.c, node.b, node.a};
  }
  switch (operand_count(node.op)) {
    case 0:
      return {};
    case 1:
      return {node.a};
    default:
      return {node.b, node.a};
  }
}

}  // namespace

std::string undefined_reason(const Program& program, std::span<const Interval> slots) {
  REQUIRES(!program.is_condition());
  REQUIRES(std::ranges::all_of(program.variables(), [&](std::uint32_t slot) { return slot < slots.size(); }));
  Evaluator<Interval> values(program);
  if (values.number(slots).total) return "";
  // Down from the result through what is undefined; conditions are gone through for what they compare.
  std::vector<std::uint32_t> pending{static_cast<std::uint32_t>(program.nodes.size() - 1)};
  while (!pending.empty()) {
    const Program::Node& node = program.nodes[pending.back()];
    pending.pop_back();
    if (is_argument_of_table(program, node) && values.at(node.b).total)
      return reason_of_table(program, node, values);
    bool descends = false;
    for (const std::uint32_t operand : operands(node, values)) {
      const bool condition = is_condition(program.nodes[operand].op);
      if (!condition && values.at(operand).total) continue;
      pending.push_back(operand);
      descends = descends || !condition;
    }
    if (!descends && !is_condition(node.op) && node.op != Operator::if_else) return reason_at(node, values);
  }
  return "";
}

}  // namespace coordreq

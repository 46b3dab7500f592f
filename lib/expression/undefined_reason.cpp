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

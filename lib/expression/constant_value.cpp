#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "expression/domains.hpp"
#include "expression/functions.hpp"
#include "expression/place.hpp"
#include "expression/truth_of.hpp"

namespace coordreq {
namespace {

using Outcome = Constant::Outcome;

Constant applied(Operator op, const Constant& a, const Constant& b) {
  if (a.outcome != Outcome::value) return a;
  if (b.outcome != Outcome::value) return b;
  const NumberFunction& function = number_function(op);
  if (std::optional<Rational> value = function.exactly(a.value, b.value)) return {Outcome::value, *value};
  return function.rounded(a.value, b.value);
}

Truth comparison(Operator op, const Constant& a, const Constant& b) {
  if (a.outcome != Outcome::value || b.outcome != Outcome::value) return Truth::undecided;
  return compare(op, a.value, b.value);
}

Constant number(const Program& program, const Program::Node& node, const std::vector<Constant>& numbers,
                const std::vector<Truth>& truths) {
  if (node.op == Operator::constant) return {Outcome::value, program.constants[node.a]};
  if (node.op == Operator::if_else) {
    if (truths[node.a] == Truth::undecided) return {Outcome::undefined, 0};
    return truths[node.a] == Truth::yes ? numbers[node.b] : numbers[node.c];
  }
  return applied(node.op, numbers[node.a], numbers[is_unary_function(node.op) ? node.a : node.b]);
}

Constant evaluate(const Program& program) {
  const std::size_t size = program.nodes.size();
  std::vector<Constant> numbers(size);
  std::vector<Truth> truths(size, Truth::undecided);
  for (std::size_t i = 0; i < size; ++i) {
    const Program::Node& node = program.nodes[i];
    if (is_condition(node.op)) {
      truths[i] =
          truth_of(node, truths, [&] { return comparison(node.op, numbers[node.a], numbers[node.b]); });
    } else {
      numbers[i] = number(program, node, numbers, truths);
    }
  }
  return numbers.back();
}

}  // namespace

Rational constant_value(const Program& program, std::string_view where) {
  const std::string text = in_quotes(program.text);
  if (program.is_condition()) throw SpecError("expected a number, found a condition", where);
  if (!program.variables().empty()) throw SpecError(fmt::format("{} is not a constant", text), where);
  const Constant result = evaluate(program);
  switch (result.outcome) {
    case Outcome::undefined:
      throw SpecError(fmt::format("{} has no real value", text), where);
    case Outcome::zero_divisor:
      throw SpecError(fmt::format("{} divides by zero", text), where);
    case Outcome::not_finite:
      throw SpecError(fmt::format("{} is not finite", text), where);
    case Outcome::too_large:
      throw SpecError(fmt::format("{} is too large to be computed exactly", text), where);
    case Outcome::value:
      break;
  }
  if (!std::isfinite(nearest_double(result.value))) {
    throw SpecError(fmt::format("{} is too large for a double", text), where);
  }
  return result.value;
}

}  // namespace coordreq

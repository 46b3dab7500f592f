#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "expression/exact_apply.hpp"
#include "expression/place.hpp"
#include "expression/program.hpp"
#include "numeric/correct_rounding.hpp"
#include "numeric/truth.hpp"

namespace coordreq {
namespace {

enum class Outcome : std::uint8_t { value, undefined, zero_divisor, not_finite, too_large };

/// The value of a node, or why it has none.
struct Constant {
  Outcome outcome = Outcome::undefined;
  Rational value = 0;
};

Constant from_double(double value) {
  if (!std::isfinite(value)) return {Outcome::not_finite, 0};
  return {Outcome::value, exact(value)};
}

std::optional<ElementaryFunction> elementary_function(Operator op) {
  switch (op) {
    case Operator::sine:
      return ElementaryFunction::sine;
    case Operator::cosine:
      return ElementaryFunction::cosine;
    case Operator::tangent:
      return ElementaryFunction::tangent;
    case Operator::arcsine:
      return ElementaryFunction::arcsine;
    case Operator::arccosine:
      return ElementaryFunction::arccosine;
    case Operator::arctangent:
      return ElementaryFunction::arctangent;
    case Operator::hyperbolic_sine:
      return ElementaryFunction::hyperbolic_sine;
    case Operator::hyperbolic_cosine:
      return ElementaryFunction::hyperbolic_cosine;
    case Operator::hyperbolic_tangent:
      return ElementaryFunction::hyperbolic_tangent;
    case Operator::exponential:
      return ElementaryFunction::exponential;
    case Operator::logarithm:
      return ElementaryFunction::logarithm;
    case Operator::square_root:
      return ElementaryFunction::square_root;
    default:
      return std::nullopt;
  }
}

Constant unary(Operator op, const Constant& a) {
  if (a.outcome != Outcome::value) return a;
  if (std::optional<Rational> value = exact_apply(op, a.value)) return {Outcome::value, *value};
  const std::optional<ElementaryFunction> function = elementary_function(op);
  if (!function) return {Outcome::undefined, 0};
  const std::optional<double> value = nearest_value(*function, a.value);
  return value ? from_double(*value) : Constant{Outcome::undefined, 0};
}

/// a^b where exact_apply has no answer.
Constant irrational_power(const Rational& a, const Rational& b) {
  if (sgn(a) == 0) return {Outcome::zero_divisor, 0};  // 0^b with b < 0
  if (sgn(a) < 0 && !is_integer(b)) return {Outcome::undefined, 0};
  if (is_integer(b)) return {Outcome::too_large, 0};
  return from_double(nearest_power(a, b));
}

Constant binary(Operator op, const Constant& a, const Constant& b) {
  if (a.outcome != Outcome::value) return a;
  if (b.outcome != Outcome::value) return b;
  if (std::optional<Rational> value = exact_apply(op, a.value, b.value)) return {Outcome::value, *value};
  if (op == Operator::power) return irrational_power(a.value, b.value);
  const bool by_zero = op == Operator::divide && sgn(b.value) == 0;
  return {by_zero ? Outcome::zero_divisor : Outcome::too_large, 0};
}

Truth comparison(Operator op, const Constant& a, const Constant& b) {
  if (a.outcome != Outcome::value || b.outcome != Outcome::value) return Truth::undecided;
  return to_truth(exact_compare(op, a.value, b.value));
}

Truth condition(const Program::Node& node, const std::vector<Constant>& numbers,
                const std::vector<Truth>& truths) {
  switch (node.op) {
    case Operator::logical_and:
      return truth_and(truths[node.a], truths[node.b]);
    case Operator::logical_or:
      return truth_or(truths[node.a], truths[node.b]);
    case Operator::logical_not:
      return !truths[node.a];
    case Operator::literal_true:
      return Truth::yes;
    case Operator::literal_false:
      return Truth::no;
    default:
      return comparison(node.op, numbers[node.a], numbers[node.b]);
  }
}

Constant number(const Program& program, const Program::Node& node, const std::vector<Constant>& numbers,
                const std::vector<Truth>& truths) {
  if (node.op == Operator::constant) return {Outcome::value, program.constants[node.a]};
  if (node.op == Operator::if_else) {
    if (truths[node.a] == Truth::undecided) return {Outcome::undefined, 0};
    return truths[node.a] == Truth::yes ? numbers[node.b] : numbers[node.c];
  }
  if (is_unary_function(node.op)) return unary(node.op, numbers[node.a]);
  return binary(node.op, numbers[node.a], numbers[node.b]);
}

Constant evaluate(const Program& program) {
  const std::size_t size = program.nodes.size();
  std::vector<Constant> numbers(size);
  std::vector<Truth> truths(size, Truth::undecided);
  for (std::size_t i = 0; i < size; ++i) {
    const Program::Node& node = program.nodes[i];
    if (is_condition(node.op)) {
      truths[i] = condition(node, numbers, truths);
    } else {
      numbers[i] = number(program, node, numbers, truths);
    }
  }
  return numbers.back();
}

}  // namespace

Rational constant_value(const Program& program, std::string_view where) {
  const std::string text = quoted(program.text);
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

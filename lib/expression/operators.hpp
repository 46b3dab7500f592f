#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace coordreq {

/// Everything a node of an expression can be. What there is to know of the operations on numbers stands in
/// one table: see number_function().
enum class Operator : std::uint8_t {
  // numbers without operands
  constant,
  variable,
  // number, number -> number
  add,
  subtract,
  multiply,
  divide,
  power,  // `a ^ b` and `pow(a, b)`
  angle,  // `atan2(y, x)`
  minimum,
  maximum,
  // number -> number
  negate,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  exponential,
  logarithm,
  square_root,
  absolute,
  sign,
  floor,
  // number, number -> number, written out by whoever makes a tape
  modulo,
  // condition, number, number -> number
  if_else,
  // number, number -> condition
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  // conditions -> condition
  logical_and,
  logical_or,
  logical_not,
  literal_true,
  literal_false,
  literal_undecided,  // of a memory that does not know; not in the grammar
};

[[nodiscard]] constexpr bool is_condition(Operator op) {
  return op >= Operator::less;
}
[[nodiscard]] constexpr bool is_comparison(Operator op) {
  return op >= Operator::less && op <= Operator::not_equal;
}
[[nodiscard]] constexpr bool is_unary_function(Operator op) {
  return op >= Operator::negate && op <= Operator::floor;
}
/// An operation that makes a number of one or two numbers.
[[nodiscard]] constexpr bool is_number_function(Operator op) {
  return op >= Operator::add && op <= Operator::floor;
}

/// A number that may jump where its operands do not.
[[nodiscard]] constexpr bool is_discontinuous(Operator op) {
  return op == Operator::angle || op == Operator::sign || op == Operator::floor || op == Operator::if_else;
}

/// How many of the members a, b and c of a node with this operator refer to other nodes.
[[nodiscard]] constexpr std::size_t operand_count(Operator op) {
  if (op <= Operator::variable || op >= Operator::literal_true) return 0;
  if (is_unary_function(op) || op == Operator::logical_not) return 1;
  return op == Operator::if_else ? 3 : 2;
}

/// The spelling in a spec, for messages: "sin", "+", "and".
[[nodiscard]] std::string_view spelling(Operator op);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <string_view>

namespace coordreq {

/// Everything a node of an expression can be. Names follow the grammar of the spec.
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
};

[[nodiscard]] constexpr bool is_condition(Operator op) {
  return op >= Operator::less;
}
[[nodiscard]] constexpr bool is_comparison(Operator op) {
  return op >= Operator::less && op <= Operator::not_equal;
}
[[nodiscard]] constexpr bool is_unary_function(Operator op) {
  return op >= Operator::negate && op <= Operator::sign;
}

/// The spelling in a spec, for messages: "sin", "+", "and".
[[nodiscard]] std::string_view spelling(Operator op);

}  // namespace coordreq

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "expression/operators.hpp"
#include "numeric/interval.hpp"
#include "numeric/rational.hpp"
#include "numeric/rational_interval.hpp"

namespace coordreq {

struct Dual;

/// A constant, or why there is none.
struct Constant {
  enum class Outcome : std::uint8_t { value, undefined, zero_divisor, not_finite, too_large };
  Outcome outcome = Outcome::undefined;
  Rational value = 0;
};

/// How coefficient k of the Taylor series of r = f(p, q) along a curve follows from those of p and q (Moore
/// 1966; Griewank and Walther 2008, ch. 13); a' is the derivative along the curve.
enum class SeriesRule : std::uint8_t {
  fixed,          ///< no moving variable below: r_k = 0 for k > 0
  variable,       ///< of the curve itself
  sum,            ///< r = p + q
  difference,     ///< r = p - q
  negation,       ///< r = -p
  product,        ///< r = p q
  quotient,       ///< r = p / q
  chain,          ///< r' = q p', as sin with q = cos
  inverse_chain,  ///< q r' = p', as log with q = p
  root,           ///< r^2 = p
  power,          ///< r = p^q for a fixed q
  angle,          ///< (p^2 + q^2) r' = q p' - p q'
  pick,           ///< a kink or a jump: one of +-p, q or a constant, as the surroundings decide
};

/// Where a tape of operations grows: see FunctionSeries::factor.
class NodeWriter {
 public:
  using Index = std::uint32_t;
  /// The node `op` of earlier nodes.
  virtual Index put_operation(Operator op, Index a, Index b = 0) = 0;
  virtual Index put_number(int value) = 0;

 protected:
  NodeWriter() = default;
  NodeWriter(const NodeWriter&) = default;
  NodeWriter& operator=(const NodeWriter&) = default;
  ~NodeWriter() = default;
};

/// The Taylor series of a function. The operands p and q of the rule are those of the function.
struct FunctionSeries {
  SeriesRule rule;
  /// The q of `chain` (the derivative of r = f(a) by a) or of `inverse_chain` (1 over it), written as nodes;
  /// null for the other rules.
  NodeWriter::Index (*factor)(NodeWriter& nodes, NodeWriter::Index a, NodeWriter::Index r);
};

/// An operation that makes a number of one or two numbers, and all that is known of it: a function of the
/// grammar is a row of one table (functions.cpp). Functions of one number ignore `b`.
struct NumberFunction {
  template <class T>
  using Of = T (*)(const T& a, const T& b);

  static constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

  Operator op;
  std::string_view spelling;  ///< for messages
  std::string_view call;      ///< its name in a call; empty if there is only a symbol
  std::size_t fewest;         ///< arguments of a call; of several, the operation goes from left to right
  std::size_t most;

  Of<double> at_point;                ///< no guarantee; NaN where undefined
  Of<Interval> on_interval;           ///< encloses the range
  Of<RationalInterval> on_rationals;  ///< the same, exact where the operation is rational
  Of<Dual> on_dual;                   ///< range and derivative
  /// The value where it is defined, rational, and seen to be so: rational operations within the limits of
  /// numeric/rational_functions.hpp, roots that come out even, and values such as exp(0) = 1. Else nothing.
  std::optional<Rational> (*exactly)(const Rational& a, const Rational& b);
  /// The constant where `exactly` has none: the correctly rounded double, or why there is no value.
  Constant (*rounded)(const Rational& a, const Rational& b);
  FunctionSeries series;
  /// What is undefined, in words with {0} and {1} for the operands: "square root of {0}"; "" if the operation
  /// is defined everywhere.
  const char* undefined;
  int half_turns;  ///< the function repeats itself after so many times pi; kNever if it does not

  static constexpr int kNever = -1;
  [[nodiscard]] constexpr bool is_defined_everywhere() const { return *undefined == '\0'; }
};

/// The whole table, in the order of Operator.
[[nodiscard]] std::span<const NumberFunction> number_functions();
/// @pre is_number_function(op)
[[nodiscard]] const NumberFunction& number_function(Operator op);

}  // namespace coordreq

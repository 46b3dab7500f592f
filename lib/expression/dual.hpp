#pragma once

#include <array>
#include <cstddef>

#include "expression/operators.hpp"
#include "numeric/interval.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// The range of an expression f over a box together with bounds of its differences, as an evaluation domain:
/// for all points a, b of the box
///
///     f(a) - f(b)  in  sum_j gradient[j] * (a_j - b_j) + 2 * jump.
///
/// Where f is differentiable, `gradient` encloses its derivatives over the box; at kinks of abs, min and max
/// it holds Clarke's generalised gradient. A discontinuity (`sign`, `floor`, `atan2` across its cut, or `if`
/// with a condition that the box leaves undecided) has no derivative: its value is replaced by a free number
/// in the hull V of the values it may take, and what V - mid(V) adds to f is `jump`, symmetric about 0. Hence
/// 2 * jump between two points of f itself, but only `jump` between f and the function with mid(V) put in for
/// the discontinuity.
///
/// Directions are the variables that were seeded, at most kDirections of them; variables without a direction
/// stand for themselves, and differences are then between points that agree there. Over-approximates; an
/// end is infinite where no bound exists. `total` as in Interval.
struct Dual {
  static constexpr std::size_t kDirections = 8;

  Interval value;
  Interval jump{0.0, 0.0};
  std::size_t directions = 0;  ///< gradient[j] is zero for j >= directions
  std::array<Interval, kDirections> gradient{};
  bool total = true;

  [[nodiscard]] static Dual constant(const Interval& value);
  /// The variable of direction j < kDirections over `range`.
  [[nodiscard]] static Dual variable(const Interval& range, std::size_t j);
};

/// A double in the middle of a bounded interval, and in every interval.
[[nodiscard]] double midpoint(const Interval& a);

// The operations that Evaluator<Dual> needs.
[[nodiscard]] Dual from_rational(const Dual* tag, const Rational& q);
[[nodiscard]] Dual apply(Operator op, const Dual& a);
[[nodiscard]] Dual apply(Operator op, const Dual& a, const Dual& b);
[[nodiscard]] Truth compare(Operator op, const Dual& a, const Dual& b);
[[nodiscard]] Dual select(Truth condition, const Dual& a, const Dual& b);

// The operations, by the chain rule.
[[nodiscard]] Dual operator+(const Dual& a, const Dual& b);
[[nodiscard]] Dual operator-(const Dual& a, const Dual& b);
[[nodiscard]] Dual operator*(const Dual& a, const Dual& b);
[[nodiscard]] Dual operator/(const Dual& a, const Dual& b);
[[nodiscard]] Dual pow(const Dual& a, const Dual& b);
[[nodiscard]] Dual atan2(const Dual& y, const Dual& x);
[[nodiscard]] Dual min(const Dual& a, const Dual& b);
[[nodiscard]] Dual max(const Dual& a, const Dual& b);
[[nodiscard]] Dual operator-(const Dual& a);
[[nodiscard]] Dual sin(const Dual& a);
[[nodiscard]] Dual cos(const Dual& a);
[[nodiscard]] Dual tan(const Dual& a);
[[nodiscard]] Dual asin(const Dual& a);
[[nodiscard]] Dual acos(const Dual& a);
[[nodiscard]] Dual atan(const Dual& a);
[[nodiscard]] Dual sinh(const Dual& a);
[[nodiscard]] Dual cosh(const Dual& a);
[[nodiscard]] Dual tanh(const Dual& a);
[[nodiscard]] Dual exp(const Dual& a);
[[nodiscard]] Dual log(const Dual& a);
[[nodiscard]] Dual sqrt(const Dual& a);
[[nodiscard]] Dual abs(const Dual& a);
[[nodiscard]] Dual sign(const Dual& a);
[[nodiscard]] Dual floor(const Dual& a);

}  // namespace coordreq

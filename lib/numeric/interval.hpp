#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numeric/outward.hpp"
#include "numeric/rational.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// A closed interval [lower, upper] of doubles that encloses all values an expression can take.
///
/// Every operation returns an enclosure of {op(a, b) : a in A, b in B where op is defined}. `total` says
/// that the operation (and everything before it) is defined on all of A x B; a comparison of intervals that
/// are not total is undecided. An operation defined nowhere returns the whole line, not total.
/// Ends may be infinite, never NaN; lower < +infinity and upper > -infinity.
///
/// + - * / sqrt are rounded outward only where they are inexact (error-free transformations decide), so that
/// exact results stay exact; no rounding mode is ever changed. Elementary functions are widened by more
/// than the error bound of the C library in use.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;
  bool total = true;

  constexpr Interval() = default;
  constexpr Interval(double from, double to, bool is_total = true)
      : lower(from), upper(to), total(is_total) {}
  /// {value}.
  explicit constexpr Interval(double value) : Interval(value, value) {}

  [[nodiscard]] bool is_point() const { return lower == upper; }
  [[nodiscard]] bool is_zero() const { return lower == 0.0 && upper == 0.0; }
  [[nodiscard]] bool is_finite() const { return lower >= -outward::kLargest && upper <= outward::kLargest; }
  /// Rounded to nearest.
  [[nodiscard]] double width() const { return upper - lower; }
  /// The largest |x|.
  [[nodiscard]] double magnitude() const { return std::max(std::fabs(lower), std::fabs(upper)); }
  [[nodiscard]] bool contains(double value) const { return lower <= value && value <= upper; }
};

/// The whole line.
[[nodiscard]] inline Interval whole_line(bool total) {
  return {-outward::kInfinity, outward::kInfinity, total};
}

/// The narrowest interval of doubles that contains q; a point if q is a double.
[[nodiscard]] Interval enclose(const Rational& q);
/// The narrowest one that contains [lower, upper].
[[nodiscard]] inline Interval enclose(const Rational& lower, const Rational& upper) {
  return {lower_double(lower), upper_double(upper)};
}

/// The end on a side, as a number that grows outward: the upper one, or the lower one with its sign changed.
[[nodiscard]] inline double outward_end(const Interval& a, bool upper) {
  return upper ? a.upper : -a.lower;
}

/// The smallest interval that contains both.
[[nodiscard]] inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper), a.total && b.total};
}

/// The points of both; nothing if there are none.
[[nodiscard]] inline std::optional<Interval> intersect(const Interval& a, const Interval& b) {
  const Interval both{std::max(a.lower, b.lower), std::min(a.upper, b.upper), a.total && b.total};
  return both.lower <= both.upper ? std::optional<Interval>(both) : std::nullopt;
}

[[nodiscard]] inline Interval operator-(const Interval& a) {
  return {-a.upper, -a.lower, a.total};
}

[[nodiscard]] inline Interval operator+(const Interval& a, const Interval& b) {
  return {outward::add_down(a.lower, b.lower), outward::add_up(a.upper, b.upper), a.total && b.total};
}

[[nodiscard]] inline Interval operator-(const Interval& a, const Interval& b) {
  return {outward::add_down(a.lower, -b.upper), outward::add_up(a.upper, -b.lower), a.total && b.total};
}

[[nodiscard]] inline Interval operator*(const Interval& a, const Interval& b) {
  using outward::multiply_down;
  using outward::multiply_up;
  const bool total = a.total && b.total;
  if (a.lower >= 0.0) {
    return {multiply_down(b.lower >= 0.0 ? a.lower : a.upper, b.lower),
            multiply_up(b.upper >= 0.0 ? a.upper : a.lower, b.upper), total};
  }
  if (a.upper <= 0.0) {
    return {multiply_down(b.upper >= 0.0 ? a.lower : a.upper, b.upper),
            multiply_up(b.lower >= 0.0 ? a.upper : a.lower, b.lower), total};
  }
  if (b.lower >= 0.0) return {multiply_down(a.lower, b.upper), multiply_up(a.upper, b.upper), total};
  if (b.upper <= 0.0) return {multiply_down(a.upper, b.lower), multiply_up(a.lower, b.lower), total};
  return {std::min(multiply_down(a.lower, b.upper), multiply_down(a.upper, b.lower)),
          std::max(multiply_up(a.lower, b.lower), multiply_up(a.upper, b.upper)), total};
}

/// a / b where b contains 0: a half-line if b lies on one side of 0 and a keeps its sign, {0} if a is {0} and
/// b is not, else the whole line; never total. @pre b contains 0
[[nodiscard]] Interval divide_by_zero(const Interval& a, const Interval& b);

[[nodiscard]] inline Interval operator/(const Interval& a, const Interval& b) {
  using outward::divide_down;
  using outward::divide_up;
  const bool total = a.total && b.total;
  if (b.lower > 0.0) {
    return {divide_down(a.lower, a.lower >= 0.0 ? b.upper : b.lower),
            divide_up(a.upper, a.upper >= 0.0 ? b.lower : b.upper), total};
  }
  if (b.upper < 0.0) {
    return {divide_down(a.upper, a.upper >= 0.0 ? b.upper : b.lower),
            divide_up(a.lower, a.lower >= 0.0 ? b.lower : b.upper), total};
  }
  return divide_by_zero(a, b);
}

[[nodiscard]] inline Interval abs(const Interval& a) {
  if (a.lower >= 0.0) return a;
  if (a.upper <= 0.0) return -a;
  return {0.0, std::max(-a.lower, a.upper), a.total};
}

/// {a^2}: unlike a * a it knows that both factors are the same.
[[nodiscard]] inline Interval sqr(const Interval& a) {
  const Interval magnitude = abs(a);
  return {outward::multiply_down(magnitude.lower, magnitude.lower),
          outward::multiply_up(magnitude.upper, magnitude.upper), a.total};
}

/// -1, 0 or 1.
[[nodiscard]] inline Interval sign(const Interval& a) {
  const auto of = [](double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; };
  return {of(a.lower), of(a.upper), a.total};
}

/// The greatest whole number that is not above.
[[nodiscard]] inline Interval floor(const Interval& a) {
  return {std::floor(a.lower), std::floor(a.upper), a.total};
}

[[nodiscard]] inline Interval min(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::min(a.upper, b.upper), a.total && b.total};
}

[[nodiscard]] inline Interval max(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::max(a.upper, b.upper), a.total && b.total};
}

/// Square root of the part >= 0.
[[nodiscard]] Interval sqrt(const Interval& a);

/// a^n for an integer n, also a negative one, with 0^0 = 1. Exact results stay exact for |n| <= 64.
/// @pre n is an integer (of any size)
[[nodiscard]] Interval power(const Interval& a, double n);

/// a^b: integer powers for a point b that is an integer, else exp(b log a) on a > 0 together with 0^b for b
/// >= 0. A negative base is defined at the integers in b only.
[[nodiscard]] Interval pow(const Interval& a, const Interval& b);

[[nodiscard]] Interval exp(const Interval& a);
/// Natural logarithm of the part > 0.
[[nodiscard]] Interval log(const Interval& a);

/// Intervals that are no points are reduced by counting the quarter turns they can touch, with an enclosure
/// of pi; from |a| > 1e15 on that says nothing and the result is [-1, 1] (the whole line for tan).
[[nodiscard]] Interval sin(const Interval& a);
[[nodiscard]] Interval cos(const Interval& a);
/// The whole line, not total, if a may contain a pole.
[[nodiscard]] Interval tan(const Interval& a);
/// Arc sine and arc cosine of the part of `a` within [-1, 1].
[[nodiscard]] Interval asin(const Interval& a);
[[nodiscard]] Interval acos(const Interval& a);
[[nodiscard]] Interval atan(const Interval& a);

/// The angle of the points (x, y), in (-pi, pi]; undefined at the origin. It jumps where they cross the
/// half-line y = 0, x < 0, and is then anything.
[[nodiscard]] Interval atan2(const Interval& y, const Interval& x);
[[nodiscard]] inline bool meets_cut_of_angles(const Interval& y, const Interval& x) {
  return x.lower < 0.0 && y.lower < 0.0 && y.upper >= 0.0;
}

[[nodiscard]] Interval sinh(const Interval& a);
[[nodiscard]] Interval cosh(const Interval& a);
[[nodiscard]] Interval tanh(const Interval& a);

}  // namespace coordreq

#pragma once

#include <cmath>

#include "expression/dual.hpp"
#include "numeric/interval.hpp"

namespace coordreq {

/// The numbers within `radius` of `middle`. Where intervals are narrow, as in Taylor coefficients, this takes
/// a third of the time of Interval: no case distinctions, and rounding errors go into the radius as bounds.
///
/// Over-approximates. A radius that is infinite or NaN stands for the whole line.
struct Ball {
  double middle = 0.0;
  double radius = 0.0;

  [[nodiscard]] bool is_zero() const { return middle == 0.0 && radius == 0.0; }
};

namespace ball {
/// More than the relative error of one rounding.
inline constexpr double kRounding = 0x1.01p-53;
/// Covers the roundings in the computation of a radius from non-negative numbers.
inline constexpr double kSlack = 1.0 + 0x1p-48;
/// More than what underflow can take away.
inline constexpr double kTiny = 0x1p-1000;
}  // namespace ball

[[nodiscard]] inline Ball to_ball(double value) {
  return {value, 0.0};
}
[[nodiscard]] inline Ball to_ball(const Interval& a) {
  if (a.is_point()) return {a.lower, 0.0};
  const double middle = midpoint(a);
  const Interval around = a - Interval{middle, middle};
  return {middle, std::max(-around.lower, around.upper)};
}
[[nodiscard]] inline Interval to_interval(const Ball& a) {
  if (!(a.radius <= outward::kLargest)) return whole_line(true);
  return Interval{a.middle, a.middle} + Interval{-a.radius, a.radius};
}

[[nodiscard]] inline Ball operator-(const Ball& a) {
  return {-a.middle, a.radius};
}
[[nodiscard]] inline Ball operator+(const Ball& a, const Ball& b) {
  const double sum = a.middle + b.middle;
  return {sum, (a.radius + b.radius + ball::kRounding * std::fabs(sum)) * ball::kSlack};
}
[[nodiscard]] inline Ball operator-(const Ball& a, const Ball& b) {
  return a + -b;
}
[[nodiscard]] inline Ball operator*(const Ball& a, const Ball& b) {
  if (a.is_zero() || b.is_zero()) return {};
  const double product = a.middle * b.middle;
  const double spread = (std::fabs(a.middle) + a.radius) * b.radius + std::fabs(b.middle) * a.radius;
  return {product, (spread + ball::kRounding * std::fabs(product) + ball::kTiny) * ball::kSlack};
}
/// The whole line if b contains 0.
[[nodiscard]] inline Ball operator/(const Ball& a, const Ball& b) {
  if (a.is_zero()) return {};
  const double least = (std::fabs(b.middle) - b.radius) * (1.0 - 0x1p-48);
  if (!(least > 0.0)) return {0.0, outward::kInfinity};
  const double quotient = a.middle / b.middle;
  const double residual = ball::kRounding * std::fabs(quotient) * std::fabs(b.middle) + ball::kTiny;
  const double spread = a.radius + std::fabs(quotient) * b.radius + residual;
  return {quotient, (spread / least + ball::kTiny) * ball::kSlack};
}

}  // namespace coordreq

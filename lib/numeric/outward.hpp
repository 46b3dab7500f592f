#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/requires.hpp"

/// Lower (`*_down`) and upper (`*_up`) bounds of one exact operation on doubles.
///
/// The bound is the rounded result itself if an error-free transformation proves it to be exact, else a
/// neighbour of it. Where the transformation could underflow or the result overflows, the bound is the
/// neighbour always. Nothing depends on the rounding mode being anything but to-nearest, and nothing sets it.
///
/// Infinite arguments stand for "arbitrarily large", so 0 * infinity is 0 and no bound is ever NaN, provided
/// that a lower end is never +infinity and an upper end never -infinity.
namespace coordreq::outward {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kLargest = std::numeric_limits<double>::max();
/// Products and dividends above this have a rounding error that is a double too.
inline constexpr double kSafeMagnitude = 0x1p-960;

/// `x` moved by `steps` doubles, up if positive; stops at the infinities. @pre x is not NaN
[[nodiscard]] inline double moved(double x, std::int64_t steps) {
  REQUIRES(!std::isnan(x));
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  const auto bits = std::bit_cast<std::int64_t>(x);
  // Doubles in ascending order are these integers in ascending order, with both zeros at 0.
  const std::int64_t order = (bits < 0 ? kLeast - bits : bits) + steps;
  const auto end = std::bit_cast<std::int64_t>(kInfinity);
  const std::int64_t clamped = std::clamp(order, -end, end);
  return std::bit_cast<double>(clamped < 0 ? kLeast - clamped : clamped);
}
[[nodiscard]] inline double next_down(double x) {
  return moved(x, -1);
}
[[nodiscard]] inline double next_up(double x) {
  return moved(x, 1);
}

[[nodiscard]] inline double add_down(double a, double b) {
  const double sum = a + b;
  if (!(std::fabs(sum) <= kLargest)) return sum == kInfinity ? kLargest : -kInfinity;
  const double b_virtual = sum - a;
  const double error = (a - (sum - b_virtual)) + (b - b_virtual);
  return error >= 0.0 ? sum : next_down(sum);  // NaN after an overflow on the way counts as inexact
}
[[nodiscard]] inline double add_up(double a, double b) {
  return -add_down(-a, -b);
}

[[nodiscard]] inline double multiply_down(double a, double b) {
  if (a == 0.0 || b == 0.0) return 0.0;
  const double product = a * b;
  const double magnitude = std::fabs(product);
  if (magnitude >= kSafeMagnitude && magnitude <= kLargest) {
    return std::fma(a, b, -product) < 0.0 ? next_down(product) : product;
  }
  const double below = next_down(product);
  return (a > 0.0) == (b > 0.0) ? std::max(below, 0.0) : below;
}
[[nodiscard]] inline double multiply_up(double a, double b) {
  return -multiply_down(-a, b);
}

/// @pre b != 0
[[nodiscard]] inline double divide_down(double a, double b) {
  REQUIRES(b != 0.0);
  if (a == 0.0 || std::fabs(b) == kInfinity) return 0.0;
  const double quotient = a / b;
  const double magnitude = std::fabs(quotient);
  if (magnitude >= kSafeMagnitude && magnitude <= kLargest && std::fabs(a) >= kSafeMagnitude) {
    const double remainder = std::fma(-quotient, b, a);
    return (b > 0.0 ? remainder : -remainder) < 0.0 ? next_down(quotient) : quotient;
  }
  const double below = next_down(quotient);
  return (a > 0.0) == (b > 0.0) ? std::max(below, 0.0) : below;
}
/// @pre b != 0
[[nodiscard]] inline double divide_up(double a, double b) {
  REQUIRES(b != 0.0);
  return -divide_down(-a, b);
}

/// @pre a >= 0
[[nodiscard]] inline double square_root_down(double a) {
  REQUIRES(a >= 0.0);
  const double root = std::sqrt(a);
  if (a == 0.0) return 0.0;
  if (a < kSafeMagnitude || a > kLargest) return next_down(root);
  return std::fma(-root, root, a) < 0.0 ? next_down(root) : root;
}
/// @pre a >= 0
[[nodiscard]] inline double square_root_up(double a) {
  REQUIRES(a >= 0.0);
  const double root = std::sqrt(a);
  if (a == 0.0) return 0.0;
  if (a < kSafeMagnitude || a > kLargest) return next_up(root);
  return std::fma(-root, root, a) > 0.0 ? next_up(root) : root;
}

}  // namespace coordreq::outward

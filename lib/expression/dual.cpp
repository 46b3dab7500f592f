#include "expression/dual.hpp"

#include <algorithm>
#include <cmath>

#include "expression/domains.hpp"
#include "expression/functions.hpp"

namespace coordreq {
namespace {

constexpr Interval kZero{0.0, 0.0};
constexpr Interval kOne{1.0, 1.0};

bool is_constant(const Dual& a) {
  return a.directions == 0 && a.jump.is_zero();
}

Interval scaled(const Interval& factor, const Interval& a) {
  if (a.is_zero()) return kZero;
  return factor.lower == 1.0 && factor.upper == 1.0 ? a : factor * a;
}

/// V - mid(V), made symmetric.
Interval deviation(const Interval& range) {
  const double middle = midpoint(range);
  const Interval around = range - Interval{middle, middle};
  const double radius = std::max(-around.lower, around.upper);
  return {-radius, radius};
}

/// A value that is free in its range: what a discontinuity is replaced by.
Dual free_value(const Interval& range) {
  Dual result = Dual::constant(range);
  result.jump = deviation(range);
  return result;
}

/// The result of a function that is constant except for jumps.
Dual jump_of(const Interval& range, bool total) {
  Dual result = range.is_point() ? Dual::constant(range) : free_value(range);
  result.total = total;
  return result;
}

/// The chain rule for a function of one number.
Dual chained(const Dual& a, const Interval& value, const Interval& factor) {
  Dual result;
  result.value = value;
  result.total = a.total && value.total;
  result.directions = a.directions;
  for (std::size_t j = 0; j < a.directions; ++j) result.gradient[j] = scaled(factor, a.gradient[j]);
  result.jump = scaled(factor, a.jump);
  return result;
}

/// The chain rule for a function of two numbers.
Dual combined(const Dual& a, const Interval& factor_a, const Dual& b, const Interval& factor_b,
              const Interval& value) {
  Dual result;
  result.value = value;
  result.total = a.total && b.total && value.total;
  result.directions = std::max(a.directions, b.directions);
  for (std::size_t j = 0; j < result.directions; ++j) {
    result.gradient[j] = scaled(factor_a, a.gradient[j]) + scaled(factor_b, b.gradient[j]);
  }
  result.jump = scaled(factor_a, a.jump) + scaled(factor_b, b.jump);
  return result;
}

Dual hull_of(const Dual& a, const Dual& b, const Interval& value) {
  Dual result;
  result.value = value;
  result.total = a.total && b.total && value.total;
  result.directions = std::max(a.directions, b.directions);
  for (std::size_t j = 0; j < result.directions; ++j) {
    result.gradient[j] = hull(a.gradient[j], b.gradient[j]);
  }
  result.jump = hull(a.jump, b.jump);
  return result;
}

/// max(p, q) - max(r, s) lies between p - r and q - s, so that the hull of both gradients bounds it.
Dual extreme(const Dual& a, const Dual& b, bool first_always, bool second_always, const Interval& value) {
  if (first_always == second_always) return hull_of(a, b, value);
  Dual result = first_always ? a : b;
  result.value = value;
  result.total = a.total && b.total;
  return result;
}

/// 1 over the derivative of asin.
Interval cosine_of_arcsine(const Interval& a) {
  return sqrt(max(kOne - sqr(a), kZero));
}

}  // namespace

double midpoint(const Interval& a) {
  if (a.lower == -outward::kInfinity) return a.upper == outward::kInfinity ? 0.0 : std::min(a.upper, 0.0);
  if (a.upper == outward::kInfinity) return std::max(a.lower, 0.0);
  if (a.is_point()) return a.lower;
  return std::clamp(0.5 * a.lower + 0.5 * a.upper, a.lower, a.upper);
}

Dual Dual::constant(const Interval& value) {
  Dual result;
  result.value = value;
  result.total = value.total;
  return result;
}

Dual Dual::variable(const Interval& range, std::size_t j) {
  Dual result = constant(range);
  result.directions = j + 1;
  result.gradient[j] = kOne;
  return result;
}

Dual from_rational(const Dual* /*tag*/, const Rational& q) {
  return Dual::constant(enclose(q));
}

Dual apply(Operator op, const Dual& a) {
  const NumberFunction& function = number_function(op);
  if (!is_constant(a)) return function.on_dual(a, a);
  const Interval value = function.on_interval(a.value, a.value);
  return Dual::constant({value.lower, value.upper, value.total && a.total});
}

Dual apply(Operator op, const Dual& a, const Dual& b) {
  return number_function(op).on_dual(a, b);
}

Truth compare(Operator op, const Dual& a, const Dual& b) {
  if (!a.total || !b.total) return Truth::undecided;
  return compare(op, a.value, b.value);
}

Dual select(Truth condition, const Dual& a, const Dual& b) {
  if (condition != Truth::undecided) return condition == Truth::yes ? a : b;
  Dual result = free_value(hull(a.value, b.value));
  result.total = a.total && b.total;
  return result;
}

Dual operator+(const Dual& a, const Dual& b) {
  return combined(a, kOne, b, kOne, a.value + b.value);
}

Dual operator-(const Dual& a, const Dual& b) {
  return combined(a, kOne, b, -kOne, a.value - b.value);
}

Dual operator*(const Dual& a, const Dual& b) {
  return combined(a, b.value, b, a.value, a.value * b.value);
}

/// Delta(a / b) = (Delta a - (a / b) Delta b) / b, with a / b and b at different points.
Dual operator/(const Dual& a, const Dual& b) {
  const Interval value = a.value / b.value;
  Dual result = combined(a, kOne, b, -value, value);
  for (std::size_t j = 0; j < result.directions; ++j) {
    if (!result.gradient[j].is_zero()) result.gradient[j] = result.gradient[j] / b.value;
  }
  if (!result.jump.is_zero()) result.jump = result.jump / b.value;
  return result;
}

Dual pow(const Dual& a, const Dual& b) {
  const Interval value = pow(a.value, b.value);
  const Interval by_base = b.value * pow(a.value, b.value - kOne);
  if (is_constant(b)) return chained(a, {value.lower, value.upper, value.total && b.total}, by_base);
  const Interval by_exponent = value * log(a.value);
  return combined(a, is_constant(a) ? kZero : by_base, b, by_exponent, value);
}

Dual atan2(const Dual& y, const Dual& x) {
  const Interval value = atan2(y.value, x.value);
  if (meets_cut_of_angles(y.value, x.value)) return jump_of(value, y.total && x.total && value.total);
  const Interval square = sqr(y.value) + sqr(x.value);
  return combined(y, x.value / square, x, -(y.value / square), value);
}

Dual min(const Dual& a, const Dual& b) {
  return extreme(a, b, a.value.upper <= b.value.lower, b.value.upper <= a.value.lower, min(a.value, b.value));
}

Dual max(const Dual& a, const Dual& b) {
  return extreme(a, b, a.value.lower >= b.value.upper, b.value.lower >= a.value.upper, max(a.value, b.value));
}

Dual operator-(const Dual& a) {
  return chained(a, -a.value, {-1.0, -1.0});
}

Dual sin(const Dual& a) {
  return chained(a, sin(a.value), cos(a.value));
}

Dual cos(const Dual& a) {
  return chained(a, cos(a.value), -sin(a.value));
}

Dual tan(const Dual& a) {
  const Interval value = tan(a.value);
  return chained(a, value, kOne + sqr(value));
}

Dual asin(const Dual& a) {
  return chained(a, asin(a.value), kOne / cosine_of_arcsine(a.value));
}

Dual acos(const Dual& a) {
  return chained(a, acos(a.value), -(kOne / cosine_of_arcsine(a.value)));
}

Dual atan(const Dual& a) {
  return chained(a, atan(a.value), kOne / (kOne + sqr(a.value)));
}

Dual sinh(const Dual& a) {
  return chained(a, sinh(a.value), cosh(a.value));
}

Dual cosh(const Dual& a) {
  return chained(a, cosh(a.value), sinh(a.value));
}

Dual tanh(const Dual& a) {
  const Interval value = tanh(a.value);
  return chained(a, value, max(kOne - sqr(value), kZero));
}

Dual exp(const Dual& a) {
  const Interval value = exp(a.value);
  return chained(a, value, value);
}

Dual log(const Dual& a) {
  return chained(a, log(a.value), kOne / max(a.value, kZero));
}

Dual sqrt(const Dual& a) {
  const Interval value = sqrt(a.value);
  return chained(a, value, Interval{0.5, 0.5} / value);
}

/// Clarke's generalised gradient where `a` contains 0.
Dual abs(const Dual& a) {
  const Interval below{-1.0, a.value.upper <= 0.0 ? -1.0 : 1.0};
  return chained(a, abs(a.value), a.value.lower >= 0.0 ? kOne : below);
}

Dual sign(const Dual& a) {
  const Interval value = sign(a.value);
  return jump_of(value, a.total && value.total);
}

Dual floor(const Dual& a) {
  const Interval value = floor(a.value);
  return jump_of(value, a.total && value.total);
}

}  // namespace coordreq

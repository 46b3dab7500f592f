#include "reach/dual.hpp"

#include <algorithm>
#include <cmath>

#include "expression/domains.hpp"

namespace coordreq {
namespace {

constexpr Interval kZero{0.0, 0.0};
constexpr Interval kOne{1.0, 1.0};

bool is_zero(const Interval& a) {
  return a.lower == 0.0 && a.upper == 0.0;
}

bool is_constant(const Dual& a) {
  return a.directions == 0 && is_zero(a.jump);
}

Interval scaled(const Interval& factor, const Interval& a) {
  if (is_zero(a)) return kZero;
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

/// Delta(a / b) = (Delta a - (a / b) Delta b) / b, with a / b and b at different points.
Dual quotient_of(const Dual& a, const Dual& b, const Interval& value) {
  Dual result = combined(a, kOne, b, -value, value);
  for (std::size_t j = 0; j < result.directions; ++j) {
    if (!is_zero(result.gradient[j])) result.gradient[j] = result.gradient[j] / b.value;
  }
  if (!is_zero(result.jump)) result.jump = result.jump / b.value;
  return result;
}

Dual power_of(const Dual& a, const Dual& b, const Interval& value) {
  if (is_constant(b)) {
    const Interval factor = b.value * pow(a.value, b.value - kOne);
    return chained(a, {value.lower, value.upper, value.total && b.total}, factor);
  }
  const Interval by_base = b.value * pow(a.value, b.value - kOne);
  const Interval by_exponent = value * log(a.value);
  return combined(a, is_constant(a) ? kZero : by_base, b, by_exponent, value);
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

Interval slope(Operator f, const Interval& a, const Interval& value) {
  switch (f) {
    case Operator::negate:
      return {-1.0, -1.0};
    case Operator::sine:
      return cos(a);
    case Operator::cosine:
      return -sin(a);
    case Operator::tangent:
      return kOne + sqr(value);
    case Operator::arcsine:
      return kOne / sqrt(max(kOne - sqr(a), kZero));
    case Operator::arccosine:
      return -(kOne / sqrt(max(kOne - sqr(a), kZero)));
    case Operator::arctangent:
      return kOne / (kOne + sqr(a));
    case Operator::hyperbolic_sine:
      return cosh(a);
    case Operator::hyperbolic_cosine:
      return sinh(a);
    case Operator::hyperbolic_tangent:
      return max(kOne - sqr(value), kZero);
    case Operator::exponential:
      return value;
    case Operator::logarithm:
      return kOne / max(a, kZero);
    case Operator::square_root:
      return Interval{0.5, 0.5} / value;
    case Operator::absolute:
      return a.lower >= 0.0 ? kOne : Interval{-1.0, a.upper <= 0.0 ? -1.0 : 1.0};
    default:
      return whole_line(false);
  }
}

Dual from_rational(const Dual* /*tag*/, const Rational& q) {
  return Dual::constant(enclose(q));
}

Dual apply(Operator op, const Dual& a) {
  const Interval value = apply(op, a.value);
  if (is_constant(a)) return Dual::constant({value.lower, value.upper, value.total && a.total});
  if (op != Operator::sign) return chained(a, value, slope(op, a.value, value));
  Dual result = value.is_point() ? Dual::constant(value) : free_value(value);
  result.total = a.total && value.total;
  return result;
}

Dual apply(Operator op, const Dual& a, const Dual& b) {
  const Interval value = apply(op, a.value, b.value);
  switch (op) {
    case Operator::add:
      return combined(a, kOne, b, kOne, value);
    case Operator::subtract:
      return combined(a, kOne, b, -kOne, value);
    case Operator::multiply:
      return combined(a, b.value, b, a.value, value);
    case Operator::divide:
      return quotient_of(a, b, value);
    case Operator::power:
      return power_of(a, b, value);
    case Operator::minimum:
      return extreme(a, b, a.value.upper <= b.value.lower, b.value.upper <= a.value.lower, value);
    case Operator::maximum:
      return extreme(a, b, a.value.lower >= b.value.upper, b.value.lower >= a.value.upper, value);
    default:
      return Dual::constant(whole_line(false));
  }
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

}  // namespace coordreq

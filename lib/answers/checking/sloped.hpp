#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "expression/domains.hpp"

namespace coordreq {

/// A number type for Evaluator: all values over a box together with all derivatives there (forward
/// differentiation). N is Interval or RationalInterval.
template <class N>
struct Sloped {
  N value;
  std::vector<N> gradient;  ///< by direction; empty: all 0
  bool smooth = true;       ///< false: there may be a jump in the box, which derivatives do not show
  std::vector<N> corners;   ///< values at the corners of the box; empty: not asked for
  bool total = true;        ///< false: perhaps not defined everywhere in the box
};

namespace sloped {

template <class N>
[[nodiscard]] N number(long n) {
  return from_rational(static_cast<const N*>(nullptr), Rational(n));
}

/// f(a), given f and f' over the box.
template <class N>
[[nodiscard]] Sloped<N> chain(Operator op, const Sloped<N>& a, const N& derivative) {
  Sloped<N> result{.value = apply(op, a.value), .smooth = a.smooth};
  for (const N& slope : a.gradient) result.gradient.push_back(derivative * slope);
  for (const N& corner : a.corners) result.corners.push_back(apply(op, corner));
  result.total = a.total && result.value.total;
  return result;
}

/// f(a, b) with its partial derivatives.
template <class N>
[[nodiscard]] Sloped<N> chain(Operator op, const Sloped<N>& a, const N& by_a, const Sloped<N>& b,
                              const N& by_b) {
  Sloped<N> result{.value = apply(op, a.value, b.value), .smooth = a.smooth && b.smooth};
  const std::size_t directions = std::max(a.gradient.size(), b.gradient.size());
  for (std::size_t j = 0; j < directions; ++j) {
    N slope = number<N>(0);
    if (j < a.gradient.size()) slope = slope + by_a * a.gradient[j];
    if (j < b.gradient.size()) slope = slope + by_b * b.gradient[j];
    result.gradient.push_back(slope);
  }
  const std::size_t corners = std::max(a.corners.size(), b.corners.size());
  for (std::size_t c = 0; c < corners; ++c) {
    result.corners.push_back(
        apply(op, a.corners.empty() ? a.value : a.corners[c], b.corners.empty() ? b.value : b.corners[c]));
  }
  result.total = a.total && b.total && result.value.total;
  return result;
}

/// The derivative of a unary function over all of `a`.
template <class N>
[[nodiscard]] N derivative(Operator op, const N& a) {
  const N one = number<N>(1);
  switch (op) {
    case Operator::negate:
      return number<N>(-1);
    case Operator::sine:
      return apply(Operator::cosine, a);
    case Operator::cosine:
      return -apply(Operator::sine, a);
    case Operator::tangent: {
      const N tangent = apply(Operator::tangent, a);
      return one + tangent * tangent;
    }
    case Operator::arcsine:
      return one / apply(Operator::square_root, one - a * a);
    case Operator::arccosine:
      return -(one / apply(Operator::square_root, one - a * a));
    case Operator::arctangent:
      return one / (one + a * a);
    case Operator::hyperbolic_sine:
      return apply(Operator::hyperbolic_cosine, a);
    case Operator::hyperbolic_cosine:
      return apply(Operator::hyperbolic_sine, a);
    case Operator::hyperbolic_tangent: {
      const N tangent = apply(Operator::hyperbolic_tangent, a);
      return one - tangent * tangent;
    }
    case Operator::exponential:
      return apply(Operator::exponential, a);
    case Operator::logarithm:
      return one / a;
    case Operator::square_root:
      return one / (number<N>(2) * apply(Operator::square_root, a));
    case Operator::absolute:
      return apply(Operator::sign, a);
    default:
      return number<N>(0);
  }
}

/// d(a^b)/da and d(a^b)/db.
template <class N>
[[nodiscard]] std::pair<N, N> power_derivatives(const Sloped<N>& a, const Sloped<N>& b) {
  const N by_a = b.value * apply(Operator::power, a.value, b.value - number<N>(1));
  if (b.gradient.empty()) return {by_a, number<N>(0)};
  return {by_a, apply(Operator::power, a.value, b.value) * apply(Operator::logarithm, a.value)};
}

/// atan2(y, x), which jumps where y changes its sign at x < 0.
template <class N>
[[nodiscard]] Sloped<N> angle(const Sloped<N>& y, const Sloped<N>& x) {
  const auto squared = [](const N& a) { return apply(Operator::power, a, number<N>(2)); };
  const N square = squared(y.value) + squared(x.value);
  Sloped<N> result = chain(Operator::angle, y, x.value / square, x, -(y.value / square));
  const auto may_be_negative = [](const N& a) {
    return compare(Operator::less, a, number<N>(0)) != Truth::no;
  };
  const bool may_be_above = compare(Operator::less, y.value, number<N>(0)) != Truth::yes;
  if (may_be_negative(x.value) && may_be_negative(y.value) && may_be_above) result.smooth = false;
  return result;
}

/// The weight of `a` in min(a, b) or max(a, b): 1, 0, or [0, 1].
template <class N>
[[nodiscard]] N weight(Truth a_counts) {
  if (a_counts == Truth::undecided) return hull(number<N>(0), number<N>(1));
  return number<N>(a_counts == Truth::yes ? 1 : 0);
}

}  // namespace sloped

template <class N>
[[nodiscard]] Sloped<N> from_rational(const Sloped<N>*, const Rational& q) {
  return {.value = from_rational(static_cast<const N*>(nullptr), q)};
}

template <class N>
[[nodiscard]] Sloped<N> apply(Operator op, const Sloped<N>& a) {
  Sloped<N> result = sloped::chain(op, a, sloped::derivative(op, a.value));
  if (is_discontinuous(op) && !a.gradient.empty() && !result.value.is_point()) result.smooth = false;
  return result;
}

template <class N>
[[nodiscard]] Sloped<N> apply(Operator op, const Sloped<N>& a, const Sloped<N>& b) {
  const N one = sloped::number<N>(1);
  switch (op) {
    case Operator::add:
      return sloped::chain(op, a, one, b, one);
    case Operator::subtract:
      return sloped::chain(op, a, one, b, sloped::number<N>(-1));
    case Operator::multiply:
      return sloped::chain(op, a, b.value, b, a.value);
    case Operator::divide:
      return sloped::chain(op, a, one / b.value, b, -(a.value / b.value) / b.value);
    case Operator::power: {
      const auto [by_a, by_b] = sloped::power_derivatives(a, b);
      return sloped::chain(op, a, by_a, b, by_b);
    }
    case Operator::angle:
      return sloped::angle(a, b);
    default: {
      const Operator first = op == Operator::minimum ? Operator::less_equal : Operator::greater_equal;
      const N weight = sloped::weight<N>(compare(first, a.value, b.value));
      return sloped::chain(op, a, weight, b, one - weight);
    }
  }
}

template <class N>
[[nodiscard]] Truth compare(Operator op, const Sloped<N>& a, const Sloped<N>& b) {
  return a.total && b.total ? compare(op, a.value, b.value) : Truth::undecided;
}

/// An undecided condition may jump from one to the other within the box.
template <class N>
[[nodiscard]] Sloped<N> select(Truth condition, const Sloped<N>& a, const Sloped<N>& b) {
  if (condition == Truth::yes) return a;
  if (condition == Truth::no) return b;
  return {.value = select(condition, a.value, b.value), .smooth = false, .total = a.total && b.total};
}

}  // namespace coordreq

#pragma once

#include "base/requires.hpp"
#include "expression/functions.hpp"
#include "expression/operators.hpp"
#include "numeric/interval.hpp"
#include "numeric/rational_interval.hpp"
#include "numeric/truth.hpp"

// The operations that Evaluator<T> needs, for the three number types that ship.
namespace coordreq {

/// Plain double arithmetic, for simulation and pictures; no guarantee. NaN where undefined, also for a
/// division by 0; a comparison with NaN is undecided.
[[nodiscard]] double from_rational(const double* tag, const Rational& q);
[[nodiscard]] inline double apply(Operator op, const double& a) {
  return number_function(op).at_point(a, a);
}
[[nodiscard]] inline double apply(Operator op, const double& a, const double& b) {
  return number_function(op).at_point(a, b);
}
[[nodiscard]] Truth compare(Operator op, const double& a, const double& b);
[[nodiscard]] double select(Truth condition, const double& a, const double& b);

/// Outward-rounded double intervals.
[[nodiscard]] Interval from_rational(const Interval* tag, const Rational& q);
[[nodiscard]] inline Interval apply(Operator op, const Interval& a) {
  return number_function(op).on_interval(a, a);
}
[[nodiscard]] Interval apply(Operator op, const Interval& a, const Interval& b);
[[nodiscard]] Truth compare(Operator op, const Interval& a, const Interval& b);
[[nodiscard]] Interval select(Truth condition, const Interval& a, const Interval& b);

/// Exact rational intervals; irrational functions are enclosed outward.
[[nodiscard]] RationalInterval from_rational(const RationalInterval* tag, const Rational& q);
[[nodiscard]] inline RationalInterval apply(Operator op, const RationalInterval& a) {
  return number_function(op).on_rationals(a, a);
}
[[nodiscard]] inline RationalInterval apply(Operator op, const RationalInterval& a,
                                            const RationalInterval& b) {
  return number_function(op).on_rationals(a, b);
}
[[nodiscard]] Truth compare(Operator op, const RationalInterval& a, const RationalInterval& b);
[[nodiscard]] RationalInterval select(Truth condition, const RationalInterval& a, const RationalInterval& b);

/// Exact numbers.
[[nodiscard]] Truth compare(Operator op, const Rational& a, const Rational& b);

/// How two closed sets lie to one another.
struct Order {
  bool below = false;              ///< every a < every b
  bool above = false;              ///< every a > every b
  bool below_or_touching = false;  ///< every a <= every b
  bool above_or_touching = false;  ///< every a >= every b
};

/// "a op b" over all pairs. @pre is_comparison(op)
[[nodiscard]] constexpr Truth truth_of(Operator op, const Order& order) {
  REQUIRES(is_comparison(op));
  const auto decide = [](bool yes, bool no) { return yes ? Truth::yes : no ? Truth::no : Truth::undecided; };
  switch (op) {
    case Operator::less:
      return decide(order.below, order.above_or_touching);
    case Operator::less_equal:
      return decide(order.below_or_touching, order.above);
    case Operator::greater:
      return decide(order.above, order.below_or_touching);
    case Operator::greater_equal:
      return decide(order.above_or_touching, order.below);
    case Operator::equal:
      return decide(order.below_or_touching && order.above_or_touching, order.below || order.above);
    default:
      return decide(order.below || order.above, order.below_or_touching && order.above_or_touching);
  }
}

// Conditions are evaluated on millions of cells, so that the arithmetic is inline.
inline Interval apply(Operator op, const Interval& a, const Interval& b) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::power:
      return b.lower == 2.0 && b.upper == 2.0 && b.total ? sqr(a) : pow(a, b);
    default:
      return number_function(op).on_interval(a, b);
  }
}

inline Truth compare(Operator op, const Interval& a, const Interval& b) {
  if (!a.total || !b.total) return Truth::undecided;
  return truth_of(op, {a.upper<b.lower, a.lower> b.upper, a.upper <= b.lower, a.lower >= b.upper});
}

inline Interval select(Truth condition, const Interval& a, const Interval& b) {
  if (condition == Truth::undecided) return hull(a, b);
  return condition == Truth::yes ? a : b;
}

}  // namespace coordreq

#include "verify/expression_series.hpp"

namespace coordreq {
namespace {

/// Seen from the origin the extreme points of a box are corners, if it does not meet the cut.
Arb hull_of_corners(const Arb& y, const Arb& x) {
  const auto angle = [](const Arb& up, const Arb& right) {
    Arb result;
    arb_atan2(result.get(), up.get(), right.get(), kArbBits);
    return result;
  };
  const Arb left = hull(angle(y.lower(), x.lower()), angle(y.upper(), x.lower()));
  return hull(left, hull(angle(y.lower(), x.upper()), angle(y.upper(), x.upper())));
}

/// All terms but the constant one: r' = (x y' - y x') / (x^2 + y^2).
ArbSeries moving_term(const ArbSeries& y, const ArbSeries& x, slong length) {
  const auto product = [length](const ArbSeries& a, const ArbSeries& b) {
    ArbSeries result;
    arb_poly_mullow(result.get(), a.get(), b.get(), length, kArbBits);
    return result;
  };
  const auto derivative = [](const ArbSeries& a) {
    ArbSeries result;
    arb_poly_derivative(result.get(), a.get(), kArbBits);
    return result;
  };
  ArbSeries result, square;
  arb_poly_add(square.get(), product(x, x).get(), product(y, y).get(), kArbBits);
  square.set(0, squared(x[0]) + squared(y[0]));
  arb_poly_sub(result.get(), product(x, derivative(y)).get(), product(y, derivative(x)).get(), kArbBits);
  arb_poly_div_series(result.get(), result.get(), square.get(), length, kArbBits);
  arb_poly_integral(result.get(), result.get(), kArbBits);
  arb_poly_truncate(result.get(), length);
  return result;
}

}  // namespace

bool angle_series(ArbSeries& result, const ArbSeries& y, const ArbSeries& x, slong length) {
  const Arb up = y[0], right = x[0];
  Arb value;
  if (arb_contains_zero(up.get()) != 0 && arb_contains_zero(right.get()) != 0) {
    arb_indeterminate(value.get());
    result.assign(value);
    return false;
  }
  if (!right.is_nonnegative() && !up.is_nonnegative() && arb_is_negative(up.get()) == 0) {
    arb_const_pi(value.get(), kArbBits);
    result.assign(hull(value, Arb(0.0) - value));
    return true;
  }
  value = hull_of_corners(up, right);
  result = moving_term(y, x, length);
  result.set(0, value);
  return false;
}

}  // namespace coordreq

#include "verify/arb.hpp"

#include "base/requires.hpp"

namespace coordreq {
namespace {

Rational rational_of(const arf_t end) {
  FlintRational exact;
  arf_get_fmpq(exact.get(), end);
  return exact.value();
}

using GetEnd = void (*)(arf_t, const arb_t, slong);

Arb end_of(const Arb& ball, GetEnd get_end) {
  Arb end;
  get_end(arb_midref(end.get()), ball.get(), kArbBits);
  return end;
}

}  // namespace

Arb::Arb(const Rational& value) : Arb() {
  arb_set_fmpq(ball_, FlintRational(value).get(), kArbBits);
}

Arb Arb::lower() const {
  return end_of(*this, arb_get_lbound_arf);
}

Arb Arb::upper() const {
  return end_of(*this, arb_get_ubound_arf);
}

Arb Arb::middle() const {
  Arb result;
  arb_get_mid_arb(result.get(), ball_);
  return result;
}

Rational Arb::lower_rational() const {
  REQUIRES(is_finite());
  return rational_of(arb_midref(lower().get()));
}

Rational Arb::upper_rational() const {
  REQUIRES(is_finite());
  return rational_of(arb_midref(upper().get()));
}

/// [0, 2 r] with the radius r, which is half of what bounds |a|, as its middle.
Arb ending_at_zero(const Arb& a, bool nonnegative) {
  if (!a.is_finite() || (nonnegative ? a.is_nonnegative() : a.is_nonpositive())) return a;
  Arb result;
  mag_struct* const radius = arb_radref(result.get());
  arb_get_mag(radius, a.get());
  mag_mul_2exp_si(radius, radius, -1);
  arf_set_mag(arb_midref(result.get()), radius);
  if (!nonnegative) arf_neg(arb_midref(result.get()), arb_midref(result.get()));
  return result;
}

Arb hull(const Arb& a, const Arb& b) {
  if (arb_equal(a.get(), b.get()) != 0) return a;
  Arb result;
  arb_union(result.get(), a.get(), b.get(), kArbBits);
  if (a.is_nonnegative() && b.is_nonnegative()) return ending_at_zero(result, true);
  if (a.is_nonpositive() && b.is_nonpositive()) return ending_at_zero(result, false);
  return result;
}

Arb lesser(const Arb& a, const Arb& b) {
  REQUIRES(a.is_finite() && b.is_finite());
  return arf_cmp(arb_midref(a.lower().get()), arb_midref(b.lower().get())) <= 0 ? a : b;
}

Arb greater(const Arb& a, const Arb& b) {
  REQUIRES(a.is_finite() && b.is_finite());
  return arf_cmp(arb_midref(a.upper().get()), arb_midref(b.upper().get())) >= 0 ? a : b;
}

bool is_below(const Arb& a, const Arb& b) {
  return arf_cmp(arb_midref(a.get()), arb_midref(b.get())) < 0;
}

Arb absolute(const Arb& a) {
  if (a.is_nonnegative() || !a.is_finite()) return a;
  if (a.is_nonpositive()) return Arb(0.0) - a;
  return hull(Arb(0.0), greater(a.upper(), Arb(0.0) - a.lower()));
}

/// With the middle m and the radius r it is [(|m| - r)^2, (|m| + r)^2], or from 0 on.
Arb squared(const Arb& a) {
  const Arb middle = a.middle();
  Arb radius;
  arf_set_mag(arb_midref(radius.get()), arb_radref(a.get()));
  if (arf_cmpabs(arb_midref(middle.get()), arb_midref(radius.get())) < 0) {
    const Arb most = absolute(middle) + radius;
    return hull(Arb(0.0), most * most);
  }
  Arb result = middle * middle + radius * radius;
  mag_t error;
  mag_init(error);
  arf_get_mag(error, arb_midref(middle.get()));
  mag_mul(error, error, arb_radref(a.get()));
  mag_mul_2exp_si(error, error, 1);
  arb_add_error_mag(result.get(), error);
  mag_clear(error);
  return ending_at_zero(result, true);
}

}  // namespace coordreq

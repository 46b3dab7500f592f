#include "verify/arb.hpp"

#include "verify/flint_rational.hpp"

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
  return rational_of(arb_midref(lower().get()));
}

Rational Arb::upper_rational() const {
  return rational_of(arb_midref(upper().get()));
}

Arb hull(const Arb& a, const Arb& b) {
  Arb result;
  arb_union(result.get(), a.get(), b.get(), kArbBits);
  return result;
}

Arb lesser(const Arb& a, const Arb& b) {
  return arf_cmp(arb_midref(a.lower().get()), arb_midref(b.lower().get())) <= 0 ? a : b;
}

Arb greater(const Arb& a, const Arb& b) {
  return arf_cmp(arb_midref(a.upper().get()), arb_midref(b.upper().get())) >= 0 ? a : b;
}

bool is_below(const Arb& a, const Arb& b) {
  return arf_cmp(arb_midref(a.get()), arb_midref(b.get())) < 0;
}

}  // namespace coordreq

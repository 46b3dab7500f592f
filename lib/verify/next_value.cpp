#include "verify/next_value.hpp"

namespace coordreq {

ArbBox all_of(const SpanBox& box) {
  ArbBox result;
  result.reserve(box.size());
  for (const ArbSpan& span : box) result.push_back(span.all());
  return result;
}

/// With slopes in [-a, b] the greatest value is at most b away times what is above the place taken, and a
/// times what is below it.
EndChoice choose_for_extreme(const ArbSpan& span, const Arb& slope, bool greatest) {
  const Arb zero;
  if (arb_equal(span.lower.get(), span.upper.get()) != 0) return {span.lower, zero};
  if (slope.is_nonnegative() || slope.is_nonpositive())
    return {slope.is_nonpositive() == greatest ? span.lower : span.upper, zero};
  const Arb width = (span.upper - span.lower).upper();
  const Arb rising = greater(zero, slope.upper());
  const Arb falling = greater(zero, zero - slope.lower());
  const bool mostly_rising = is_below(falling, rising);
  const Arb& most = mostly_rising ? rising : falling;
  const Arb& least = mostly_rising ? falling : rising;
  const Arb half(0.5 + 1e-9);  // the middle is only nearly in the middle
  if (is_below(most * half, least)) return {span.middle(), (most * width * half).upper()};
  return {mostly_rising == greatest ? span.upper : span.lower, (least * width).upper()};
}

}  // namespace coordreq

#pragma once

#include "numeric/interval.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// A closed interval with exact rational ends; the exact natural interval extension of rational operations.
///
/// Same meaning of `total` as in Interval. `bounded == false` stands for the whole line (ends are then
/// meaningless). Irrational functions are enclosed through Interval, so the ends are exact only where every
/// operation was rational (or an irrational function took a rational value, as sqrt(4) or exp(0)). Ends
/// longer than kMostRationalBits are rounded outward to doubles, so that no chain of operations can exhaust
/// time or memory.
struct RationalInterval {
  Rational lower = 0;
  Rational upper = 0;
  bool total = true;
  bool bounded = true;

  /// True if this is exactly one known value.
  [[nodiscard]] bool is_point() const { return bounded && total && lower == upper; }
};

/// The narrowest Interval that contains a.
[[nodiscard]] Interval enclose(const RationalInterval& a);
/// The same set as `a`; the whole line if an end is infinite.
[[nodiscard]] RationalInterval to_rational(const Interval& a);

[[nodiscard]] RationalInterval hull(const RationalInterval& a, const RationalInterval& b);

[[nodiscard]] RationalInterval operator-(const RationalInterval& a);
[[nodiscard]] RationalInterval operator+(const RationalInterval& a, const RationalInterval& b);
[[nodiscard]] RationalInterval operator-(const RationalInterval& a, const RationalInterval& b);
[[nodiscard]] RationalInterval operator*(const RationalInterval& a, const RationalInterval& b);
/// Where b touches or contains 0: {0} for a = {0}, else the whole line, not total.
[[nodiscard]] RationalInterval operator/(const RationalInterval& a, const RationalInterval& b);

[[nodiscard]] RationalInterval abs(const RationalInterval& a);
/// -1, 0 or 1.
[[nodiscard]] RationalInterval sign(const RationalInterval& a);
[[nodiscard]] RationalInterval floor(const RationalInterval& a);
[[nodiscard]] RationalInterval min(const RationalInterval& a, const RationalInterval& b);
[[nodiscard]] RationalInterval max(const RationalInterval& a, const RationalInterval& b);

/// Square root of the part >= 0; an end that is a perfect square stays exact.
[[nodiscard]] RationalInterval sqrt(const RationalInterval& a);
/// a^b as for Interval; exact for integer exponents up to 4096, and for roots of a point that come out even.
[[nodiscard]] RationalInterval pow(const RationalInterval& a, const RationalInterval& b);

}  // namespace coordreq

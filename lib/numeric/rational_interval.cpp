#include "numeric/rational_interval.hpp"

#include <algorithm>
#include <utility>

#include "base/requires.hpp"
#include "numeric/rational_functions.hpp"

namespace coordreq {
namespace {

RationalInterval unbounded(bool total) {
  return {0, 0, total, false};
}

bool is_zero(const RationalInterval& a) {
  return a.bounded && sgn(a.lower) == 0 && sgn(a.upper) == 0;
}

bool contains_zero(const RationalInterval& a) {
  return !a.bounded || (sgn(a.lower) <= 0 && sgn(a.upper) >= 0);
}

/// Rounds ends that have grown too long outward to doubles.
RationalInterval limited(RationalInterval a) {
  if (bit_size(a.lower) <= kMostRationalBits && bit_size(a.upper) <= kMostRationalBits) return a;
  return to_rational(enclose(a));
}

/// Both ends of a * b for a and b bounded. An interval of one point costs one product.
RationalInterval product(const RationalInterval& a, const RationalInterval& b) {
  if (a.lower == a.upper) {
    RationalInterval result{a.lower * b.lower, 0, true, true};
    result.upper = b.lower == b.upper ? result.lower : Rational(a.lower * b.upper);
    if (sgn(a.lower) < 0) std::swap(result.lower, result.upper);
    return result;
  }
  if (b.lower == b.upper) return product(b, a);
  const Rational corners[4] = {a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper};
  const auto [least, greatest] = std::minmax_element(std::begin(corners), std::end(corners));
  return {*least, *greatest, true, true};
}

/// a^n where both ends stay within the limits of integer_power. @pre n >= 1 is an integer, a bounded
std::optional<RationalInterval> positive_power(const RationalInterval& a, const Rational& n) {
  REQUIRES(n >= 1 && is_integer(n) && a.bounded);
  const bool even = mpz_even_p(n.get_num_mpz_t()) != 0;
  std::optional<Rational> first = integer_power(a.lower, n);
  std::optional<Rational> last = a.lower == a.upper ? first : integer_power(a.upper, n);
  if (!first || !last) return std::nullopt;
  if (even && contains_zero(a)) return RationalInterval{0, std::max(*first, *last), a.total, true};
  if (even && sgn(a.upper) < 0) std::swap(first, last);
  return RationalInterval{*first, *last, a.total, true};
}

std::optional<RationalInterval> exact_integer_power(const RationalInterval& a, const Rational& n) {
  if (sgn(n) == 0) return RationalInterval{1, 1, a.total, true};
  if (!a.bounded) return std::nullopt;
  if (sgn(n) > 0) return positive_power(a, n);
  const std::optional<RationalInterval> denominator = positive_power(a, -n);
  if (!denominator) return std::nullopt;
  return RationalInterval{1, 1, true, true} / *denominator;
}

std::optional<RationalInterval> exact_pow(const RationalInterval& a, const RationalInterval& b) {
  if (!b.bounded || b.lower != b.upper) return std::nullopt;
  const bool total = a.total && b.total;
  if (is_integer(b.lower)) {
    std::optional<RationalInterval> result = exact_integer_power(a, b.lower);
    if (result) result->total = result->total && total;
    return result;
  }
  if (!a.bounded || a.lower != a.upper) return std::nullopt;
  const std::optional<Rational> value = exact_power(a.lower, b.lower);
  return value ? std::optional<RationalInterval>({*value, *value, total, true}) : std::nullopt;
}

}  // namespace

Interval enclose(const RationalInterval& a) {
  if (!a.bounded) return whole_line(a.total);
  return {lower_double(a.lower), upper_double(a.upper), a.total};
}

RationalInterval to_rational(const Interval& a) {
  if (!(a.lower >= -outward::kLargest && a.upper <= outward::kLargest)) return unbounded(a.total);
  return {exact(a.lower), exact(a.upper), a.total, true};
}

RationalInterval hull(const RationalInterval& a, const RationalInterval& b) {
  const bool total = a.total && b.total;
  if (!a.bounded || !b.bounded) return unbounded(total);
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper), total, true};
}

RationalInterval operator-(const RationalInterval& a) {
  return {-a.upper, -a.lower, a.total, a.bounded};
}

RationalInterval operator+(const RationalInterval& a, const RationalInterval& b) {
  const bool total = a.total && b.total;
  if (!a.bounded || !b.bounded) return unbounded(total);
  return limited({a.lower + b.lower, a.upper + b.upper, total, true});
}

RationalInterval operator-(const RationalInterval& a, const RationalInterval& b) {
  const bool total = a.total && b.total;
  if (!a.bounded || !b.bounded) return unbounded(total);
  return limited({a.lower - b.upper, a.upper - b.lower, total, true});
}

RationalInterval operator*(const RationalInterval& a, const RationalInterval& b) {
  const bool total = a.total && b.total;
  if (is_zero(a) || is_zero(b)) return {0, 0, total, true};
  if (!a.bounded || !b.bounded) return unbounded(total);
  RationalInterval result = product(a, b);
  result.total = total;
  return limited(std::move(result));
}

RationalInterval operator/(const RationalInterval& a, const RationalInterval& b) {
  if (contains_zero(b)) {
    if (is_zero(b) || !is_zero(a)) return unbounded(false);
    return {0, 0, false, true};
  }
  const RationalInterval inverse{1 / b.upper, 1 / b.lower, b.total, true};
  return a * inverse;
}

RationalInterval abs(const RationalInterval& a) {
  if (!a.bounded || sgn(a.lower) >= 0) return a;
  if (sgn(a.upper) <= 0) return -a;
  return {0, std::max(Rational(-a.lower), a.upper), a.total, true};
}

RationalInterval sign(const RationalInterval& a) {
  if (!a.bounded) return {-1, 1, a.total, true};
  return {sgn(a.lower), sgn(a.upper), a.total, true};
}

RationalInterval floor(const RationalInterval& a) {
  if (!a.bounded) return a;
  return {floor(a.lower), floor(a.upper), a.total, true};
}

RationalInterval min(const RationalInterval& a, const RationalInterval& b) {
  const bool total = a.total && b.total;
  if (!a.bounded || !b.bounded) return unbounded(total);
  return {std::min(a.lower, b.lower), std::min(a.upper, b.upper), total, true};
}

RationalInterval max(const RationalInterval& a, const RationalInterval& b) {
  const bool total = a.total && b.total;
  if (!a.bounded || !b.bounded) return unbounded(total);
  return {std::max(a.lower, b.lower), std::max(a.upper, b.upper), total, true};
}

RationalInterval sqrt(const RationalInterval& a) {
  RationalInterval result = to_rational(sqrt(enclose(a)));
  if (!a.bounded || !result.bounded || sgn(a.upper) < 0) return result;
  if (const std::optional<Rational> root = exact_root(a.upper, 2)) result.upper = *root;
  if (sgn(a.lower) < 0) return result;
  if (const std::optional<Rational> root = exact_root(a.lower, 2)) result.lower = *root;
  return result;
}

RationalInterval pow(const RationalInterval& a, const RationalInterval& b) {
  if (std::optional<RationalInterval> result = exact_pow(a, b)) return limited(std::move(*result));
  if (b.bounded && b.lower == b.upper && b.lower == Rational(1, 2)) {
    RationalInterval result = sqrt(a);
    result.total = result.total && b.total;
    return result;
  }
  return to_rational(pow(enclose(a), enclose(b)));
}

}  // namespace coordreq

#include "numeric/rational.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr long kExponentLimit = 5000;
constexpr std::int64_t kSaturation = std::int64_t{1} << 62;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view take_digits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  const std::string_view digits = text.substr(0, count);
  text.remove_prefix(count);
  return digits;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// The exponent part, 0 if there is none; nothing if it is malformed or too large.
std::optional<long> take_exponent(std::string_view& text) {
  if (!take(text, "eE")) return 0;
  const bool negative = !text.empty() && text.front() == '-';
  take(text, "+-");
  const std::string_view digits = take_digits(text);
  if (digits.empty()) return std::nullopt;
  long value = 0;
  for (const char c : digits) {
    value = value * 10 + (c - '0');
    if (value > kExponentLimit) return std::nullopt;
  }
  return negative ? -value : value;
}

mpz_class power_of(unsigned long base, unsigned long exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return result;
}

/// |q| between two neighbouring doubles: `below` <= |q| <= `above`.
struct Bracket {
  double below = 0.0;
  double above = 0.0;
  int half = 0;        ///< sign of |q| minus the middle of the two
  bool even = false;   ///< whether the significand of `below` is even
  bool exact = false;  ///< whether |q| == below
};

/// floor(n / d / 2^e) and the remainder, over the divisor that is returned in `divisor`.
mpz_class scaled_quotient(const mpz_class& n, const mpz_class& d, long e, mpz_class& remainder,
                          mpz_class& divisor) {
  mpz_class dividend = n;
  divisor = d;
  if (e >= 0) {
    divisor <<= static_cast<unsigned long>(e);
  } else {
    dividend <<= static_cast<unsigned long>(-e);
  }
  mpz_class quotient;
  mpz_tdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), dividend.get_mpz_t(), divisor.get_mpz_t());
  return quotient;
}

/// @pre q != 0
Bracket bracket(const Rational& q) {
  REQUIRES(sgn(q) != 0);
  constexpr long kDigits = std::numeric_limits<double>::digits;
  constexpr long kLeastExponent = std::numeric_limits<double>::min_exponent - kDigits;
  constexpr long kGreatestExponent = std::numeric_limits<double>::max_exponent - kDigits;
  const mpz_class n = abs(q.get_num());
  const mpz_class& d = q.get_den();
  const long bits = static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(d.get_mpz_t(), 2));
  if (bits > kGreatestExponent + kDigits + 1) {
    return {std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity(), 1, false, false};
  }
  // Without this, a value of a million binary places would be shifted by as many.
  if (bits < kLeastExponent - 2) return {0.0, std::numeric_limits<double>::denorm_min(), -1, true, false};

  long e = std::max(bits - kDigits, kLeastExponent);
  mpz_class remainder;
  mpz_class divisor;
  mpz_class quotient = scaled_quotient(n, d, e, remainder, divisor);
  if (mpz_sizeinbase(quotient.get_mpz_t(), 2) > static_cast<std::size_t>(kDigits)) {
    ++e;
    quotient = scaled_quotient(n, d, e, remainder, divisor);
  }
  if (e > kGreatestExponent) {
    return {std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity(), 1, false, false};
  }
  const int half = cmp(mpz_class(2 * remainder), divisor);
  const double m = quotient.get_d();
  const int shift = static_cast<int>(e);
  return {std::ldexp(m, shift), std::ldexp(m + 1.0, shift), half, mpz_even_p(quotient.get_mpz_t()) != 0,
          remainder == 0};
}

std::optional<double> small_integer(const Rational& q) {
  constexpr std::size_t kDigits = std::numeric_limits<double>::digits;
  if (q.get_den() != 1 || mpz_sizeinbase(q.get_num_mpz_t(), 2) > kDigits) return std::nullopt;
  return mpz_get_d(q.get_num_mpz_t());
}

std::int64_t saturate(const mpz_class& value) {
  static_assert(sizeof(long) == sizeof(std::int64_t));
  if (value > mpz_class(kSaturation)) return kSaturation;
  if (value < mpz_class(-kSaturation)) return -kSaturation;
  return value.get_si();
}

/// The number of decimal places of q, if it has finitely many and at most 17.
std::optional<unsigned long> decimal_places(const Rational& q) {
  constexpr unsigned long kMost = 17;
  for (unsigned long places = 0; places <= kMost; ++places) {
    if (mpz_divisible_p(power_of(10, places).get_mpz_t(), q.get_den_mpz_t()) != 0) return places;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Rational> parse_decimal(std::string_view text) {
  const bool negative = take(text, "-");
  const std::string_view whole = take_digits(text);
  const std::string_view fraction = take(text, ".") ? take_digits(text) : std::string_view{};
  if (whole.empty() && fraction.empty()) return std::nullopt;
  const std::optional<long> exponent = take_exponent(text);
  if (!exponent || !text.empty()) return std::nullopt;

  const mpz_class digits(std::string(whole) + std::string(fraction), 10);
  const long scale = *exponent - static_cast<long>(fraction.size());
  Rational result = scale >= 0 ? Rational(digits * power_of(10, static_cast<unsigned long>(scale)))
                               : Rational(digits, power_of(10, static_cast<unsigned long>(-scale)));
  result.canonicalize();
  return negative ? Rational(-result) : result;
}

double nearest_double(const Rational& q) {
  if (const std::optional<double> integer = small_integer(q)) return *integer;
  const Bracket b = bracket(q);
  const bool down = b.half < 0 || (b.half == 0 && b.even);
  const double magnitude = down ? b.below : b.above;
  return sgn(q) < 0 ? -magnitude : magnitude;
}

double lower_double(const Rational& q) {
  if (const std::optional<double> integer = small_integer(q)) return *integer;
  const Bracket b = bracket(q);
  if (b.exact) return sgn(q) < 0 ? -b.below : b.below;
  return sgn(q) < 0 ? -b.above : b.below;
}

double upper_double(const Rational& q) {
  if (const std::optional<double> integer = small_integer(q)) return *integer;
  const Bracket b = bracket(q);
  if (b.exact) return sgn(q) < 0 ? -b.below : b.below;
  return sgn(q) < 0 ? -b.below : b.above;
}

Rational exact(double value) {
  REQUIRES(std::isfinite(value));
  return Rational(value);
}

mpz_class whole_below(const Rational& q) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), q.get_num_mpz_t(), q.get_den_mpz_t());
  return result;
}

mpz_class whole_above(const Rational& q) {
  mpz_class result;
  mpz_cdiv_q(result.get_mpz_t(), q.get_num_mpz_t(), q.get_den_mpz_t());
  return result;
}

Rational floor(const Rational& q) {
  return Rational(whole_below(q));
}

std::int64_t floor_to_int(const Rational& q) {
  return saturate(whole_below(q));
}

std::int64_t ceil_to_int(const Rational& q) {
  return saturate(whole_above(q));
}

bool is_integer(const Rational& q) {
  return q.get_den() == 1;
}

std::string to_text(const Rational& q) {
  constexpr std::size_t kMostDigits = 17;
  const std::optional<unsigned long> places = decimal_places(q);
  if (!places || *places == 0) return q.get_str();
  const Rational scaled = abs(q) * power_of(10, *places);
  std::string digits = scaled.get_num().get_str();
  if (digits.size() > kMostDigits) return q.get_str();
  if (digits.size() <= *places) digits.insert(0, *places + 1 - digits.size(), '0');
  const std::size_t whole = digits.size() - *places;
  return (sgn(q) < 0 ? "-" : "") + digits.substr(0, whole) + "." + digits.substr(whole);
}

}  // namespace coordreq

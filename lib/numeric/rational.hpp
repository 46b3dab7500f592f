#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace coordreq {

/// An exact rational number, always in lowest terms.
using Rational = mpq_class;

/// Exact value of a decimal literal such as "-0.1", "1e-3", "12.50E+2" (the JSON number grammar, plus a
/// missing integer or fraction part as in ".5" and "5.").
/// @returns nothing if `text` is no such literal, or its decimal exponent is beyond +-5000 (a guard against
///   exhausting memory; a double ends near +-308)
[[nodiscard]] std::optional<Rational> parse_decimal(std::string_view text);

/// The double nearest to q, ties to even, correctly rounded also among subnormals; +-infinity on overflow.
[[nodiscard]] double nearest_double(const Rational& q);
/// The largest double <= q. -infinity below the range.
[[nodiscard]] double lower_double(const Rational& q);
/// The smallest double >= q. +infinity above the range.
[[nodiscard]] double upper_double(const Rational& q);
/// The exact value of a finite double. @pre std::isfinite(value)
[[nodiscard]] Rational exact(double value);

/// Greatest integer <= q and least integer >= q, saturated to +-2^62 so that sums of two stay in range.
[[nodiscard]] std::int64_t floor_to_int(const Rational& q);
[[nodiscard]] std::int64_t ceil_to_int(const Rational& q);
/// The same, of any size.
[[nodiscard]] mpz_class whole_below(const Rational& q);
[[nodiscard]] mpz_class whole_above(const Rational& q);
/// The greatest whole number that is not above q.
[[nodiscard]] Rational floor(const Rational& q);
[[nodiscard]] bool is_integer(const Rational& q);

/// q as a user would type it: a finite decimal such as "-0.25" if it is one of at most 17 digits, else "p/q".
[[nodiscard]] std::string to_text(const Rational& q);

}  // namespace coordreq

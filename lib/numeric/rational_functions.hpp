#pragma once

#include <cstddef>
#include <optional>

#include "numeric/rational.hpp"

namespace coordreq {

/// Beyond this many bits in numerator or denominator, exact arithmetic gives way to outward rounding, so that
/// no expression can exhaust time or memory.
inline constexpr std::size_t kMostRationalBits = 100'000;
/// Greatest magnitude of an exponent that is carried out exactly.
inline constexpr unsigned long kMostExactExponent = 4096;

/// Bits of the longer of numerator and denominator.
[[nodiscard]] std::size_t bit_size(const Rational& q);

/// base^exponent for an integer exponent, with 0^0 = 1.
/// @returns nothing for a negative power of 0, or if the result might exceed the two limits above
///   (0, 1 and -1 take any exponent). @pre is_integer(exponent)
[[nodiscard]] std::optional<Rational> integer_power(const Rational& base, const Rational& exponent);

/// The k-th root of q >= 0 if it is rational. @pre k >= 1
[[nodiscard]] std::optional<Rational> exact_root(const Rational& q, unsigned long k);

/// base^exponent if it is a rational number and within the limits: integer exponents, and roots that come out
/// even, as 8^(2/3) = 4. @returns nothing otherwise, also where the power is undefined (negative base with an
/// exponent that is no integer, negative power of 0).
[[nodiscard]] std::optional<Rational> exact_power(const Rational& base, const Rational& exponent);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <optional>

#include "numeric/rational.hpp"

namespace coordreq {

enum class ElementaryFunction : std::uint8_t {
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  exponential,
  logarithm,
  square_root,
};

/// The double nearest to f(q) for the exact argument q, +-infinity on overflow.
///
/// f(q) is enclosed with growing precision until both ends round to the same double (Ziv's strategy; Ziv,
/// "Fast evaluation of elementary mathematical functions with correctly rounded last bit", ACM TOMS 17(3),
/// 1991, doi 10.1145/114697.116813). This ends because f(q) is transcendental (Lindemann) or an irrational
/// root, except where it is rational for a q that is a double, and then the enclosure is a point.
/// @returns nothing where f is undefined
[[nodiscard]] std::optional<double> nearest_value(ElementaryFunction f, const Rational& q);

/// The double nearest to base^exponent, +infinity on overflow.
/// @pre base > 0, and base^exponent is irrational (exact_power() returns nothing for an exponent that is no
/// integer); a rational value could lie between two doubles indefinitely
[[nodiscard]] double nearest_power(const Rational& base, const Rational& exponent);

/// The double nearest to the angle of the point (x, y), which is 0 (seen by the caller) or transcendental.
/// @returns nothing at the origin. @pre y != 0 or x <= 0
[[nodiscard]] std::optional<double> nearest_angle(const Rational& y, const Rational& x);

}  // namespace coordreq

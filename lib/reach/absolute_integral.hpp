#pragma once

#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

/// Bernstein coefficients of g(s) = sum_k coefficient[k] * s^k on [0, end]:
/// b_i = sum_{k <= i} C(i, k) / C(n, k) * c_k * end^k. The values of g lie in their convex hull; the first
/// and the last are g(0) and g(end). @pre at least one coefficient
[[nodiscard]] std::vector<Rational> to_bernstein(const std::vector<Rational>& coefficient,
                                                 const Rational& end);

struct AbsoluteIntegral {
  Rational value;     ///< at least the integral of |g| over [0, end]
  bool exact = true;  ///< `value` is the integral itself
};

/// Upper bound of the integral of |g(s)| over [0, end] for g(s) = sum_k coefficient[k] * s^k, end >= 0.
///
/// Exact where bisection isolates the sign changes (always if g keeps its sign in Bernstein form); around an
/// irrational root an interval of 2^-24 of the range is bounded by its largest value.
[[nodiscard]] AbsoluteIntegral integral_of_absolute(const std::vector<Rational>& coefficient,
                                                    const Rational& end);

}  // namespace coordreq

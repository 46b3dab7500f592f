#pragma once

#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

/// Bernstein coefficients of g(s) = sum_k coefficient[k] * s^k on [0, end]:
/// b_i = sum_{k <= i} C(i, k) / C(n, k) * c_k * end^k. The values of g lie in their convex hull; the first
/// and the last are g(0) and g(end). @pre at least one coefficient
[[nodiscard]] std::vector<Rational> to_bernstein(const std::vector<Rational>& coefficient,
                                                 const Rational& end);

}  // namespace coordreq

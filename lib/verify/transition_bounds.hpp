#pragma once

#include <vector>

#include "numeric/interval.hpp"

namespace coordreq {

/// Encloses all transition matrices of e' = A(t) e over `duration`, for every A(t) within `jacobian` (n x n,
/// row-major): the Peano-Baker series sum_k J^k h^k / k!, its tail bounded by powers of a norm, only where a
/// path of influence exists. REQUIRES: duration.lower >= 0.
[[nodiscard]] std::vector<Interval> transition_bounds(std::size_t n, const std::vector<Interval>& jacobian,
                                                      const Interval& duration);

}  // namespace coordreq

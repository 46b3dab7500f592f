#pragma once

#include "verify/arb.hpp"

namespace coordreq {

/// Encloses all transition matrices of e' = A(t) e over `duration`, for every A(t) within `slopes`: the
/// Peano-Baker series sum_k J^k h^k / k!, its tail bounded by powers of a norm, only where a path of
/// influence exists. @pre `duration` is not negative
[[nodiscard]] ArbMatrix transition_matrix(const ArbMatrix& slopes, const Arb& duration);

}  // namespace coordreq

#pragma once

#include "answers/checking/claims.hpp"
#include "answers/checking/comparison.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Compares F, whether max_delay stopped the iteration, layer sizes and layer lists of a partition with the
/// delays of the cells.
/// @param longest the most layers of any partition so far
[[nodiscard]] Finding compare_layers(const ProblemSpec& spec, const PartitionClaims& claims,
                                     std::size_t& longest);

}  // namespace coordreq

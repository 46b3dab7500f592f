#pragma once

#include <vector>

#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "verify/claims.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// Checks what a file says about all cells together against what it says about each: sizes of S and K, the
/// number of sweeps, F, whether max_delay stopped the iteration, layer sizes and layer lists.
[[nodiscard]] std::vector<Finding> check_summary(const ProblemSpec& spec, const Claims& claims);

}  // namespace coordreq

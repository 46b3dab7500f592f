#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "verify/claims.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// Checks what a file says about coalitions against the delays that it claims, which check_cells() looks
/// after: for each cell all partitions are gone through, those whose delay reaches the horizon are compared
/// by the cost of their cheapest network (Kruskal's algorithm), then by their largest class and name, and
/// each pair of agents is looked for in all that cost least. Also the sizes that the file counts. REQUIRES:
/// the spec has a horizon.
[[nodiscard]] std::vector<Finding> check_coalition(const ProblemSpec& spec, const UniformGrid& grid,
                                                   const Claims& claims, ThreadTeam& team);

}  // namespace coordreq

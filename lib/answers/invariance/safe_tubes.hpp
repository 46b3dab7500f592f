#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// TubeSets::beyond. What `saturate` resets at the sample is beyond its limit until then, and resolve()
/// reads that as the boundary cell. So a boundary cell counts only if `safe` holds on all of it and as far
/// beyond it as any tube goes that is not blocked. (With `"safe": "center"` only centres are asked, as ever.)
/// @returns nothing where that makes no difference, or if there are no tubes
[[nodiscard]] std::optional<CellSet> safe_beyond_limits(const ProblemSpec& spec,
                                                        const Abstraction& abstraction, const CellSet& safe,
                                                        ThreadTeam& team);

}  // namespace coordreq

#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Where tubes must stay, if safety is asked for between the samples: f(x, u) is empty unless the cells of
/// resolved_tube() are in `inside`, or in `beyond` if the tube passes the limit of a state that saturates.
struct SafeTubes {
  const CellSet* inside = nullptr;  ///< S; null: there are no tubes
  const CellSet* beyond = nullptr;  ///< a part of S; null: the same as `inside`
};

/// SafeTubes::beyond. What `saturate` resets at the sample is beyond its limit until then, and resolve()
/// reads that as the boundary cell. So a boundary cell counts only if `safe` holds on all of it and as far
/// beyond it as any tube goes that is not blocked. (With `"safe": "center"` only centres are asked, as ever.)
/// @returns nothing where that makes no difference, or if there are no tubes
[[nodiscard]] std::optional<CellSet> safe_beyond_limits(const ProblemSpec& spec,
                                                        const Abstraction& abstraction, const CellSet& safe,
                                                        ThreadTeam& team);

/// True if the tube of `state` with this raw range passes a limit where the state saturates.
[[nodiscard]] bool passes_a_limit(IndexRange raw, const GridDimension& state);

}  // namespace coordreq

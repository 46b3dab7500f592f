#pragma once

#include <optional>

#include "abstraction/abstraction.hpp"
#include "base/thread_team.hpp"
#include "bitset/cell_set.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The cells that tubes may touch: f(x, u) is empty unless the box of resolved_tube() lies in this set.
/// Nothing if safety is not asked for between the samples.
///
/// It is S, with one exception. What `saturate` resets at the sample is beyond its limit until then, and
/// `resolve()` reads that as the boundary cell; so there a boundary cell counts only if `safe` holds on all
/// of it and as far beyond it as any tube goes that is not blocked. (With `"safe": "center"` only centres are
/// asked.)
[[nodiscard]] std::optional<CellSet> tube_safe_set(const ProblemSpec& spec, const Abstraction& abstraction,
                                                   const CellSet& safe, ThreadTeam& team);

}  // namespace coordreq

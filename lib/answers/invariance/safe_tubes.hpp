#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "ranks/row_share.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// How far tubes go beyond the domain where a state saturates.
struct TubeLimits {
  std::vector<GridDimension> dimensions;  ///< stretched as far as tubes go
  /// (dimension, index) Boundary cells beyond which it is not known how far tubes go.
  std::vector<std::pair<std::size_t, std::int64_t>> unknown;
};
/// @param ranks processes that have divided the tubes, together; null: there is one
/// @returns nothing if no tube goes beyond the domain, or if there are no tubes
[[nodiscard]] std::optional<TubeLimits> find_tube_limits(const ProblemSpec& spec,
                                                         const Abstraction& abstraction,
                                                         Ranks* ranks = nullptr);

/// Adds cells of TubeSets::beyond, in some rows. A state that `saturate` resets at the sample is beyond its
/// limit until then, where resolve() gives the boundary cell. So a boundary cell counts only if `safe` holds
/// on all of it and as far beyond it as any tube goes that is not blocked. (With `"safe": "center"` only
/// centres count.)
/// @param safe S, in these rows @param beyond has none of these rows yet
void add_safe_beyond(const TubeLimits& limits, const ProblemSpec& spec, const Abstraction& abstraction,
                     const CellSet& safe, const std::vector<RowShare::Range>& runs, ThreadTeam& team,
                     CellSet& beyond);

/// TubeSets::beyond in all rows; nothing where find_tube_limits() returns nothing.
[[nodiscard]] std::optional<CellSet> safe_beyond_limits(const ProblemSpec& spec,
                                                        const Abstraction& abstraction, const CellSet& safe,
                                                        ThreadTeam& team);

}  // namespace coordreq

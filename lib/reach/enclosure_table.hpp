#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"

namespace coordreq {

/// Fills the tables of states of any system from guaranteed enclosures: of the map in discrete time
/// (MapEnclosure), of the flow in continuous time (ValidatedFlow). Never too small.
/// @param states with the same dependencies, so that one flow serves them all; in discrete time one
///
/// Where x_i(tau) = x_i(0) + d and d does not depend on x_i, only d is enclosed, once for each choice of the
/// other states, and the table is filled by shifting. Cells from which no state comes to a limit that would
/// stop it have their exact posts, where that is what makes the system not exactly solvable.
/// @param own of a single state: only entries with this index of its own need to be right, unless it shifts
/// @param ranks processes that divide the work, together; null: there is one
/// @throws SpecError naming the state and a place if the state may be undefined there, may escape to infinity
///   within a period (unless it has left through an unsafe side of its own before: then the pair is blocked),
///   or if a discrete state may be off its grid
void build_enclosure_tables(const SystemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                            const std::vector<std::size_t>& states, ThreadTeam& team,
                            std::optional<std::int64_t> own = std::nullopt, Ranks* ranks = nullptr);

}  // namespace coordreq

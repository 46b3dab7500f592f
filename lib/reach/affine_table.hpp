#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"

namespace coordreq {

/// Fills the table of one state of an exactly solvable system: each post is the exact hull (or rounded
/// outward where constants are irrational).
/// @returns whether every post is exact; nothing if the dynamics are not affine for some choice of
///   parameters and inputs (the table is then unspecified)
/// @throws SpecError if a discrete state can leave its grid (naming state and input) or an equation is
///   undefined
[[nodiscard]] std::optional<bool> build_affine_table(const SystemSpec& spec, const AffineDynamics& dynamics,
                                                     Abstraction& abstraction, std::size_t state,
                                                     ThreadTeam& team);

/// Puts exact posts, and tubes, into a table made otherwise: those of cells from which, with one input, no
/// state can come to a limit that would stop it. Where limits stop integrators alone, all posts, and tubes
/// that the ends of a motion tell. Nothing where the system would not be exactly solvable without its limits,
/// or has none.
void fill_cells_off_limits(const SystemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                           std::size_t state, ThreadTeam& team);

}  // namespace coordreq

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "model/table_shape.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/affine_part.hpp"
#include "reach/affine_post.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The table of a state with all its lists at their lengths, to be filled: one entry for every choice of what
/// its next value depends on, as far as the abstraction is to hold them.
[[nodiscard]] TransitionTable full_layout(const SystemSpec& spec, const Dependencies& dependencies,
                                          std::size_t state, const Abstraction& abstraction);

/// full_layout() as a sum, with a term for each of summed_states(). @pre there are any
[[nodiscard]] TransitionTable sum_layout(const SystemSpec& spec, const Dependencies& dependencies,
                                         const AffinePart& part, std::size_t state, const UniformGrid& grid,
                                         const InputSpace& inputs);

/// Fills the table of one state of an exactly solvable system: each post is the exact hull (or rounded
/// outward where constants are irrational).
/// @returns whether every post is exact; nothing if the dynamics are not affine for some choice of
///   parameters and inputs (the table is then unspecified). Where limits stop integrators alone, and tubes
///   are asked for, false if the ends of motions tell all tubes, nothing if they do not
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

/// Fills the entries of the table of a tube that belong to one choice of parameters and inputs.
/// @param rows of AffineDynamics::tube_rows()
void fill_affine_tube(const AffinePost& post, const std::vector<SampledRow>& rows, std::int64_t base,
                      TransitionTable& tube);

/// The states that get a term in a sum for `state` (TransitionTable): those in which its next value is
/// affine, but for itself where that is a shift. Empty if a sum would say no more than other forms, or cannot
/// say it.
[[nodiscard]] std::vector<std::int32_t> summed_states(const SystemSpec& spec,
                                                      const Dependencies& dependencies,
                                                      const AffinePart& part, std::size_t state);

/// Fills the tables of states as sums: x_i(next) = sum_j Phi_ij x_j + b_i, the rest b_i being enclosed from
/// x_j = 0 for all of A, once for every choice of what else matters. As Phi depends on inputs and parameters
/// only, the sum of the ranges is the range of the sum, up to rounding: no wider than cell by cell.
///
/// Over-approximates.
/// @param states sums: in continuous time all with the same dependencies, as they share one flow; in discrete
///   time one
/// @param ranks processes that divide the work, together; null: there is one
/// @returns false if some enclosure was not found or a number is too large; the tables are then unspecified,
///   and cell by cell it may go better, or there is an error to report
[[nodiscard]] bool build_sum_tables(const SystemSpec& spec, const std::vector<TableShape>& shapes,
                                    Abstraction& abstraction, const std::vector<std::size_t>& states,
                                    ThreadTeam& team, Ranks* ranks = nullptr);

/// Fills the tables of states of any system from guaranteed enclosures: of the map in discrete time
/// (MapEnclosure), of the flow in continuous time (ValidatedFlow). Never too small.
/// @param states with the same dependencies, so that one flow serves them all; in discrete time one
///
/// Where x_i(tau) = x_i(0) + d and d does not depend on x_i, only d is enclosed, once for each choice of the
/// other states, and the table is filled by shifting. Cells from which no state comes to a limit that would
/// stop it have their exact posts, where that is what makes the system not exactly solvable.
/// @param index of a single state: only entries with this index of the state need to be right, unless it
/// shifts
/// @param ranks processes that divide the work, together; null: there is one
/// @throws SpecError naming the state and a place if the state may be undefined there, may escape to infinity
///   within a period (unless it has left through an unsafe side of its own before: then the pair is blocked),
///   or if a discrete state may be off its grid
void build_enclosure_tables(const SystemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                            const std::vector<std::size_t>& states, ThreadTeam& team,
                            std::optional<std::int64_t> index = std::nullopt, Ranks* ranks = nullptr);

/// Fills the table of a state that has an update, exactly (UpdateRanges), and its tube if there are tubes: it
/// keeps its value until the next sample.
/// @param ranks processes that divide the work, together; null: there is one
/// @pre the grid of `abstraction` is in the order of the spec
/// @throws SpecError if the state may leave its grid
void build_update_table(const SystemSpec& spec, Abstraction& abstraction, std::size_t state, ThreadTeam& team,
                        Ranks* ranks = nullptr);

}  // namespace coordreq

#pragma once

#include <vector>

#include "base/thread_team.hpp"
#include "model/table_shape.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_part.hpp"

namespace coordreq {

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

}  // namespace coordreq

#pragma once

#include <optional>
#include <vector>

#include "base/archive.hpp"
#include "base/thread_team.hpp"
#include "model/model.hpp"
#include "model/table_shape.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The problem made ready. @pre unchecked: `spec` outlives it. @throws SpecError as table_shapes()
[[nodiscard]] Model make_model(const ProblemSpec& spec);

/// Builds the finite abstraction. Each post is the exact interval hull in rational arithmetic where the
/// system is exact (contract, "Cells"), else rounded outward: never too small.
/// @param shapes of table_shapes()
/// @param held Abstraction::held
/// @param ranks processes that divide the work and all have the whole of it then, but for what is not held,
/// together; null: there is one
/// @throws SpecError if a discrete state's next value can be off its grid (naming state and input), if an
///   equation is undefined somewhere, or if the dynamics are beyond this version
[[nodiscard]] Abstraction build_abstraction(const SystemSpec& spec, const std::vector<TableShape>& shapes,
                                            ThreadTeam& team, std::optional<HeldCells> held = {},
                                            Ranks* ranks = nullptr);
[[nodiscard]] Abstraction build_abstraction(const SystemSpec& spec, ThreadTeam& team);

/// Works out the tables of discrete states, unless they are very large: what else could be wrong with a spec
/// is seen before. @throws SpecError as build_abstraction() does
void check_discrete_states(const SystemSpec& spec, const std::vector<TableShape>& shapes, ThreadTeam& team);

/// Adds the cells in which a state that saturates may be measured to its table, which has been filled: the
/// state is at the last (first) grid point, however far out the post lies, and an error of half a cell or
/// more shows it in other cells than the boundary one. build_abstraction() calls this.
void include_measurements_of_saturated(const SystemSpec& spec, Abstraction& abstraction, std::size_t state);

/// Saves the tables of an abstraction, or loads those that were saved, state by state. Their sizes are those
/// that the spec gives them.
/// @pre when loading, grid and inputs are those of make_grid() and make_input_space(); when saving, the
/// states may be arranged in another order, and rows joined
void serialise(Archive& archive, const SystemSpec& spec, Abstraction& abstraction);

}  // namespace coordreq

#pragma once

#include <cstddef>

#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Fills the table of a state that has an update, exactly (UpdateRanges), and its tube if there are tubes: it
/// keeps its value until the next sample.
/// @param ranks processes that divide the work, together; null: there is one
/// @pre the grid of `abstraction` is in the order of the spec
/// @throws SpecError if the state may leave its grid
void build_update_table(const SystemSpec& spec, Abstraction& abstraction, std::size_t state, ThreadTeam& team,
                        Ranks* ranks = nullptr);

}  // namespace coordreq

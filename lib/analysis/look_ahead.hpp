#pragma once

#include <cstdint>

#include "answers/warning.hpp"
#include "base/thread_team.hpp"
#include "model/model.hpp"

namespace coordreq {

/// What an analysis would find at once, without the whole of its tables: within a bounded amount of work,
/// which no clock decides.
///
/// 1. Equations are evaluated over boxes of cells, halved where they may be undefined, down to single cells,
///    whose posts are then computed; so are those of some cells drawn at random.
/// 2. `safe` is evaluated likewise: if it is false in all boxes, no cell satisfies it.
///
/// Tables that are sums are left out: they are small. An example: `1/x` over 10^9 cells takes some 60 boxes
/// to come to the cell at x = 0.
/// @param posts about so many entries of tables are computed, and ten times as many boxes looked at
/// @returns a warning if nothing satisfies `safe` @throws SpecError as build_abstraction()
[[nodiscard]] Warnings look_ahead(const Model& model, std::int64_t posts, ThreadTeam& team);

}  // namespace coordreq

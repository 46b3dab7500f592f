#pragma once

#include <optional>

#include "answers/one_cell/cell_posts.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "expression/program.hpp"
#include "model/uniform_grid.hpp"
#include "ranks/row_share.hpp"

// The region of states that a requirement is about: {x : where(x)} (contract, section 2, `where`).
namespace coordreq {

/// The cells that may be measured while the state is in the region: closed cells, widened by the measurement
/// errors and without what lies beyond a `stop` limit, in which `where` holds at some point, or may, or is
/// perhaps not defined. A cell that ends at the seam of a periodic state ends in front of it, as the seam is
/// the lower end of the period. Errs towards more cells.
/// Cost: most of the grid is told from the region in large blocks, the cells at its border one by one.
/// @pre unchecked: `where` is over states only.
/// @param share then those in own rows at least; null: all
[[nodiscard]] CellSet cells_of_region(const Program& where, const UniformGrid& grid, ThreadTeam& team,
                                      const RowShare* share = nullptr);

/// The first side (in the order of the dimensions, below before above) of those beyond which the region may
/// reach; nothing if it cannot leave the domain.
///
/// Only `unsafe` sides count: beyond a `safe` one the system is safe for ever, beyond a `saturate` or `stop`
/// limit it never is at a sample, and a periodic state has no outside. What may be measured beyond the outer
/// face counts, and so does touching it; the next value of a discrete state is a whole step away. Conditions
/// are decided by interval evaluation over the whole outside, exactly at its ends, which is cut into parts
/// where that is too coarse; a condition that stays undecided counts as true.
[[nodiscard]] std::optional<DomainSide> side_reached(const Program& where, const UniformGrid& grid);

}  // namespace coordreq

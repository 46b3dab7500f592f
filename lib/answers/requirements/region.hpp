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
/// errors and cut off at `stop` limits, in which `where` holds at some point, or may hold, or is perhaps not
/// defined. A cell that ends at the seam of a periodic state ends in front of it, as the seam is the lower
/// end of the period. Errs towards more cells. Cost: large boxes of cells are decided at once, cells at the
/// border of the region one by one.
/// @pre unchecked: `where` is over states only.
/// @param share then at least the cells in own rows; null: all cells
[[nodiscard]] CellSet cells_of_region(const Program& where, const UniformGrid& grid, ThreadTeam& team,
                                      const RowShare* share = nullptr);

/// The first side (in the order of the dimensions, below before above) beyond which the region may reach;
/// nothing if it cannot leave the domain.
///
/// Only `unsafe` sides count: beyond a `safe` one the system is safe indefinitely, beyond a `saturate` or
/// `stop` limit it never is at a sample, and a periodic state has no outside. States that may be measured
/// beyond the outer face count, and so does the face itself; the next value of a discrete state is a whole
/// step away. Conditions are decided by interval evaluation over the whole outside, exactly at its ends, and
/// over pieces of it where that is too coarse; a condition that stays undecided counts as true.
[[nodiscard]] std::optional<DomainSide> side_reached(const Program& where, const UniformGrid& grid);

}  // namespace coordreq

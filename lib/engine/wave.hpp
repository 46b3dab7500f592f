#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/equal_work.hpp"
#include "engine/post_reader.hpp"
#include "engine/row_hull.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

/// An operator on levels, a row at a time: the least level that a cell can go to, under the best or the worst
/// of the actions that the operator considers. Called by several threads at once, each with a worker number
/// and a reader of its own.
template <class Level>
class RowOperator {
 public:
  virtual ~RowOperator() = default;
  /// Writes to `next` (whole blocks) for each cell x of the row the greatest i such that x is in op(Z) for
  /// the first i sets Z; Z_i = {y : level(y) > i}. Monotone in the levels. Cells with old[c] = 0 do not
  /// count.
  /// @param old present levels, 0 in lanes beyond the row
  /// @param worker number of the thread in its team
  /// @returns false if no level would change; `next` is then not looked at
  virtual bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old,
                           Level* next, int worker) = 0;
  /// Levels rise, see run_wave(): they are the nearness of a goal.
  [[nodiscard]] virtual bool rises() const { return false; }
  /// next_levels() is a minimum over posts, and nowhere above old[c] - 1: levels of posts that are the same
  /// as when the row was looked at last need not be read again.
  [[nodiscard]] virtual bool is_minimum() const { return false; }
};

/// The greatest solution of level(x) = 1 + op(level)(x) below the given levels, a level above `limit`
/// counting as kTop. The solution is the level sequence of the synchronous iteration Z <- Z n op(Z), by
/// Knaster and Tarski: op is monotone, so the order in which rows are computed does not matter.
///
/// Rows are therefore swept in batches, to and fro over the grid, each batch seeing the levels that those
/// before it have found: levels travel through the whole grid in one sweep where motion is one way, instead
/// of one step a sweep. (The layers of the intersection take 5 sweeps and 1.8 visits a row instead of 90
/// sweeps.)
///
/// Example: a line of cells 0, ..., 5, all in K. Every action of cell c leads to c + 1, and beyond 5 is
/// unsafe, so that cell c is lost in 6 - c steps. All levels begin as kTop ("^").
///
///     given                        ^ ^ ^ ^ ^ ^
///     sweep 1, from 0 to 5         ^ ^ ^ ^ ^ 1    only cell 5 has a post that is blocked: 1 + 0
///     sweep 2, from 5 to 0         6 5 4 3 2 1    each cell sees what the one after it has just become
///     sweep 3                      6 5 4 3 2 1    nothing changes: this is the solution
///
/// The synchronous iteration takes 7 rounds for the same: its Z_k are {c : level(c) > k}. Where the limit is
/// 3, levels above it count as kTop, ^ ^ ^ 3 2 1.
///
/// Threads: called by one thread, which shares each batch with the team and calls `watch.step` between
/// batches. Nobody else may touch the levels meanwhile. Of several processes all call it together.
///
/// 1. While threads compute a batch no level changes; rows are written when all of them are through. So the
///    result, and every count, is the same for any number of threads.
/// 2. A unit is looked at in at most one batch of a sweep.
/// 3. Of the rows that can still change those are visited whose unit has not been looked at yet, or whose
///    posts can meet a row that has changed in or after the batch that looked at their unit last. So a row
///    that is passed over would keep its levels.
/// 4. Levels are never below the solution (above it where they rise), so that work that was broken off can
///    begin anew at any step.
/// 5. Between batches permuted rows are equal to their canonical row, if there is a symmetry.
/// @pre unchecked: the given levels are nowhere below the solution. Where 1 + op(levels) is nowhere above
/// them they only ever sink. Else some may rise before they sink, yet the end is the same: if all levels have
/// come below the k-th set of levels of the synchronous iteration from kTop, they come below the next one,
/// too.
///
/// Of several processes (RowEngine::share()) each sweeps the rows that it owns. Levels of its ghost rows
/// (GhostExchange) may be too high, never too low, so that the solution is the same; it is found when no row
/// has changed on any rank in a whole sweep.
///
/// Where the operator says that levels rise, the least solution of level(x) = max(given(x), op(level)(x) - 1)
/// instead. A cell has level kTop - i if it is i steps from a goal, 1 if it is not known to come there, and
/// 0, always, if it does not count. So the least level of a post is that of its farthest cell, and readers
/// and operators serve both kinds of levels. There is no limit then, and i goes up to kTop - 2.
/// @param watch its `resumed` is not looked at
/// @param equal tiles whose numbers, with the levels, are all that the operator's result depends on. Where
///   rows of levels are interned, work that is equal to work done in the same sweep is not done again. Of
///   rows that are permuted only the canonical one is computed. @pre unchecked: then there is one process,
///   and levels are the same in permuted rows
template <class Level>
WaveCounts run_wave(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
                    RowOperator<Level>& op, const WaveWatch& watch, ThreadTeam& team,
                    const EqualWork& equal = {});

}  // namespace coordreq

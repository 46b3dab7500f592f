#pragma once

#include <cstdint>
#include <functional>

#include "base/thread_team.hpp"
#include "bitset/row_operations.hpp"
#include "safety/row_reach.hpp"

namespace coordreq {

/// One fixed point iteration Z <- Z n op(Z), synchronous: every step sees the set as the step before left it.
struct Wave {
  /// Clears from `keep` (which comes in as the row of the current set) the cells of `row` that leave.
  /// Called for different rows by several threads at once.
  std::function<void(std::int64_t row, const RowTarget& current, MutableRow keep, int worker)> shrink;
  /// Told of the cells of a row that leave at a step (1, 2, ...); called for different rows by several
  /// threads.
  std::function<void(std::int64_t row, ConstRow removed, std::int64_t step)> removed;
  /// Told after each step how many cells are left; from the calling thread.
  std::function<void(std::int64_t step, std::int64_t cells_left)> stepped;
};

struct WaveResult {
  std::int64_t steps = 0;    ///< steps done, a last one without change included
  bool fixed_point = false;  ///< false if `max_steps` came first
};

/// Runs the wave on `set`. A cell can leave at a step only if its post meets a cell that left at the step
/// before, so after the first step only rows whose reach meets a changed row are looked at again; the result
/// is that of full sweeps.
/// @param max_steps stop after so many steps; negative: no limit
WaveResult run_wave(CellSet& set, const Wave& wave, const RowEngine& engine, const RowReach& reach,
                    std::int64_t max_steps, ThreadTeam& team);

}  // namespace coordreq

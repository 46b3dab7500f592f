#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "base/archive.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_map.hpp"
#include "engine/level_rows.hpp"

// Views of levels and sets for an archive.
namespace coordreq {

/// The cells of levels, without their margins.
template <class Level>
[[nodiscard]] NumberRows rows_of(const LevelRows<Level>& levels) {
  if (levels.rows() == 0) return {};
  NumberRows rows = number_rows(levels.first_slot(), levels.stride(), levels.rows(), levels.row_length());
  if (levels.is_interned()) rows.slots = levels.slots().data();
  return rows;
}

[[nodiscard]] inline NumberRows rows_of(const CellSet& set) {
  return number_rows(set.words().data(), set.words_per_row(), set.rows(), set.words_per_row());
}

/// The work of a fixed point, of all processes together. The same for any number of threads.
struct WaveCounts {
  std::int64_t sweeps = 0;
  std::int64_t rows_visited = 0;  ///< visits: a row counts each time that its levels are computed
  std::int64_t rows_copied = 0;   ///< rows that got the levels of a row computed in the same sweep
  std::int64_t rows_skipped =
      0;  ///< rows whose levels can still sink, passed over as no row that they can meet had changed

  void add(const WaveCounts& other) {
    sweeps += other.sweeps;
    rows_visited += other.rows_visited;
    rows_copied += other.rows_copied;
    rows_skipped += other.rows_skipped;
  }
};

/// How far the work on a fixed point has come.
struct WaveStep {
  std::int64_t sweep = 0;      ///< number of the sweep under way
  std::int64_t visited = 0;    ///< rows that it has computed so far
  std::int64_t rows_left = 0;  ///< rows that it has not come to yet, of those whose cells can still be lost
  std::int64_t rows = 0;       ///< all rows whose cells can still be lost
  /// The greatest i such that the first i sets of the sequence (see RowOperator) are known to be final: no
  /// cell will have another level up to i than it has now. -1: none is known to be.
  std::int64_t layer = -1;
  /// The levels, from which the work can be taken up later; empty at a step where it cannot. Several
  /// processes come to such a step together, each with the rows that it holds.
  std::span<const NumberRows> state;
};

/// Observes work on a fixed point, and says where to take up work that was broken off.
struct WaveWatch {
  /// Called often, between two batches, by the thread that asked for the fixed point; may be empty. An
  /// exception from it ends the work.
  std::function<void(const WaveStep&)> step;
  /// Levels that `step` was given under the same problem; moved from. Null: begin at the start.
  ///
  /// The result is the same. At any step the levels L lie above the greatest solution G, since they began
  /// above it and only sink by level(x) <- 1 + op(level)(x), under which nothing above G gets below it. And
  /// 1 + op(L) <= L: it holds at the start, and where a row has sunk to 1 + op(L), op of the lower levels is
  /// nowhere higher than it was. So L is as good a start as any, if every row is looked at again.
  LevelMap* resumed = nullptr;
};

}  // namespace coordreq

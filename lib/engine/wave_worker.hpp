#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/dirty_rows.hpp"
#include "engine/tile_memo.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// What a batch of a wave did, in rows.
struct BatchCounts {
  std::int64_t visited = 0;
  std::int64_t copied = 0;    ///< instead of being visited
  std::int64_t permuted = 0;  ///< made equal to their canonical row
  std::int64_t changed = 0;   ///< of all of these but the permuted ones
};

/// Rows of one unit for one thread.
struct WaveTask {
  std::int64_t unit;
  std::int64_t begin;
  std::int64_t end;
  bool is_wanted;           ///< its rows are known to be pending
  std::uint32_t query = 0;  ///< TileMemo::ask()
};

/// What one thread works with on a batch of a wave, and the rows that it has found changed.
template <class Level>
struct WaveWorker {
  static constexpr Level kTop = LevelRows<Level>::kTop;
  /// A row that has changed.
  struct Change {
    std::int64_t row;
    std::size_t offset;  ///< in the worker's storage
    typename LevelRows<Level>::Ready ready;
  };

  WaveWorker(int w, const PostReader<Level>& first, const DirtyRows& dirty_rows)
      : number(w),
        posts(first),
        old(posts.lanes(), 0),
        next(posts.lanes(), 0),
        result(posts.lanes(), 0),
        dirty(dirty_rows.make_scratch()) {}

  /// result = the levels of some lanes of a row. @returns whether they change
  bool find(const LevelRows<Level>& levels, RowOperator<Level>& op, Level limit, const RowPosition& position,
            LaneRange lanes) {
    const auto n = static_cast<std::size_t>(levels.row_length());
    const Level* const row = levels.row(position.row);
    std::fill(old.data(), old.data() + lanes.begin, Level{0});
    std::copy(row + lanes.begin, row + lanes.end, old.data() + lanes.begin);
    std::fill(old.data() + lanes.end, old.data() + n, Level{0});
    levels.clear_gaps(old.data());
    if (!op.next_levels(position, posts, old.data(), next.data(), number)) return false;
    const LevelKernels<Level>& kernels = posts.kernels();
    const bool is_changed = op.rises() ? kernels.rise(next.data(), old.data(), result.data(), n)
                                       : kernels.advance(next.data(), old.data(), limit, result.data(), n);
    if (is_changed && !op.rises())
      lowest = std::min(lowest, kernels.lowest_change(result.data(), old.data(), n));
    return is_changed;
  }

  /// Keeps a row that has changed until the batch is done.
  void keep(const LevelRows<Level>& levels, std::int64_t row, const Level* cells) {
    const std::size_t offset = storage.size();
    storage.resize(offset + static_cast<std::size_t>(levels.stride()));
    Level* const lanes = storage.data() + offset;
    std::copy_n(cells, levels.row_length(), lanes + levels.margins().before);
    changes.push_back({row, offset, levels.make_ready(lanes)});
  }

  int number;
  PostReader<Level> posts;
  std::vector<Level> old;
  std::vector<Level> next;
  std::vector<Level> result;
  std::vector<Level> storage;  ///< rows that have changed
  std::vector<Change> changes;
  std::vector<WaveTask> chosen;
  DirtyRows::Scratch dirty;
  typename TileMemo<Level>::Scratch memo;
  BatchCounts counts;
  Level lowest = kTop;  ///< to which a cell has sunk
};

}  // namespace coordreq

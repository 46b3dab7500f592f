#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_rows.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// The greatest level for the cells of a set in the rows [begin, end), 0 for others, margins included.
template <class Level>
void set_levels(const CellSet& set, std::int64_t begin, std::int64_t end, LevelRows<Level>& levels) {
  const LevelKernels<Level>& kernels = level_kernels<Level>(best_instruction_set());
  // By way of a buffer: the kernel writes whole blocks, beyond the row.
  std::vector<Level> lanes(static_cast<std::size_t>(levels.row_length()) + kLevelBlock / sizeof(Level));
  for (std::int64_t r = begin; r < end; ++r) {
    kernels.spread(set.row(r).data(), lanes.data(), static_cast<std::size_t>(levels.row_length()));
    std::copy_n(lanes.begin(), levels.row_length(), levels.row(r));
    levels.close(r);
  }
}

/// The greatest level for the cells of a set, 0 for all others, laid out for the posts of an engine.
template <class Level>
[[nodiscard]] LevelRows<Level> top_levels(const RowEngine& engine, const CellSet& set, ThreadTeam& team) {
  LevelRows<Level> levels = engine.make_levels<Level>(engine.posts());
  team.for_each(levels.rows(), 256,
                [&](ThreadTeam::Range range, int) { set_levels(set, range.begin, range.end, levels); });
  return levels;
}

}  // namespace coordreq

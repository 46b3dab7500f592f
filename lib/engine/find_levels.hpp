#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/level_map.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// A fixed point to be found, whatever the width of its levels.
struct LevelProblem {
  const CellSet* start = nullptr;  ///< the first set; levels of its cells are above 0
  /// Cells that keep kTop without being asked about; null: none. @pre unchecked: they have kTop in the start
  /// and in all bounds, and `equal` tells apart rows that differ in them
  const CellSet* spared = nullptr;
  /// Levels that are not below the solution: each with the same start, the greatest solution of
  /// level = 1 + op'(level) for some op' that is nowhere below this problem's, under the same limit.
  ///
  /// The wave begins at their pointwise minimum B instead of at the start, with the same result:
  /// 1. Nothing is lost. The greatest solution L below the start has L = 1 + op(L) <= 1 + op'(L), so it lies
  ///    below the greatest solution of each op' (Knaster and Tarski), hence below B; and whatever lies below
  ///    B lies below the start.
  /// 2. From B levels only ever sink, as run_wave() requires: 1 + op(B) <= 1 + op'(L') = L' for each bound
  ///    L', since B <= L' and op is monotone, so 1 + op(B) <= B.
  std::vector<const LevelMap*> bounds;
  /// The numbers that, with the levels, the operator depends on; see run_wave().
  EqualWork equal = {};
  /// Finite levels go up to this; cells that would have more count as never lost. Negative: no limit.
  std::int64_t limit = -1;
  std::function<std::unique_ptr<RowOperator<std::uint8_t>>()> make8;
  std::function<std::unique_ptr<RowOperator<std::uint16_t>>()> make16;
  std::function<std::unique_ptr<RowOperator<std::uint32_t>>()> make32;
};

/// Runs the wave with 8 bits a cell, and goes on with 16 or 32 where 8 turn out not to be enough: most
/// problems have fewer than 254 finite levels, and a row of bytes is a quarter as long as one of 32 bits. The
/// switch is FastPaths::narrow_levels. Levels that are resumed keep their width.
[[nodiscard]] LevelMap find_levels(const RowEngine& engine, const RowHull& hull, const LevelProblem& problem,
                                   const WaveWatch& watch, ThreadTeam& team, WaveCounts& counts);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "bitset/level_map.hpp"
#include "safety/wave.hpp"

namespace coordreq {

/// What a fixed point is asked for, whatever the width of its levels.
struct LevelProblem {
  const CellSet* start = nullptr;  ///< the first set; levels of its cells are above 0
  /// Finite levels go up to this; cells that would have more count as never lost. Negative: no limit.
  std::int64_t limit = -1;
  std::function<std::unique_ptr<RowOperator<std::uint8_t>>()> make8;
  std::function<std::unique_ptr<RowOperator<std::uint16_t>>()> make16;
  std::function<std::unique_ptr<RowOperator<std::uint32_t>>()> make32;
};

/// Runs the wave with 8 bits a cell, and goes on with more where they turn out not to be enough.
[[nodiscard]] LevelMap find_levels(const RowEngine& engine, const RowHull& hull, const LevelProblem& problem,
                                   const std::function<void(std::int64_t, std::int64_t)>& swept,
                                   ThreadTeam& team, WaveCounts& counts);

}  // namespace coordreq

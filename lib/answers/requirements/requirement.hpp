#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/layers/delay_layers.hpp"
#include "answers/requirements/region.hpp"
#include "base/thread_team.hpp"

namespace coordreq {

/// What is asked of all cells of a region.
struct CellRequirement {
  const LevelMap* collision_time = nullptr;  ///< Controller::collision_time
  /// Of the partition that is meant; null: membership in K, where all agents together tolerate any delay.
  const DelayLayers* layers = nullptr;
  std::int64_t min_delay = 0;  ///< steps
};

/// What became of it.
struct CellVerdict {
  std::int64_t cells = 0;    ///< of the region
  std::int64_t failing = 0;  ///< of these
  /// The least delay of all cells of the region, as DelayLayers has them: kOutsideSafe, kOutsideInvariant,
  /// steps, kUnbounded. A lower bound where `max_delay` cut the delays off.
  std::int32_t least_delay = DelayLayers::kUnbounded;
  /// The failing cell with the least delay; of these that with the least collision time; then the
  /// lowest-numbered.
  std::optional<std::int64_t> worst;
};

/// The delay of a cell, as DelayLayers has them. @param collision_time its level
/// @param layers may be null: see CellRequirement
[[nodiscard]] std::int32_t delay_of(std::int64_t cell, std::int64_t collision_time,
                                    const DelayLayers* layers);

/// @param region over the same grid as the levels
/// @param number_stride [dimension]: what one index adds to a cell's number
[[nodiscard]] CellVerdict judge_cells(const CellSet& region, const UniformGrid& grid,
                                      const CellRequirement& requirement,
                                      const std::vector<std::int64_t>& number_stride, ThreadTeam& team);

}  // namespace coordreq

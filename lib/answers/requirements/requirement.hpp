#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/layers/delay_layers.hpp"
#include "answers/requirements/region.hpp"
#include "answers/risk/risk.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// What is asked of all cells of a region.
struct CellRequirement {
  const LevelMap* collision_time = nullptr;  ///< Controller::levels
  RequirementKind kind = RequirementKind::invariant;
  /// Of the partition that is meant, of safety or of the approach; null: membership in K, where all agents
  /// together tolerate any delay.
  const DelayLayers* layers = nullptr;
  const LevelMap* nearness = nullptr;  ///< if arrivals are asked for
  const RiskRows* risks = nullptr;     ///< if risks are asked for: in the mode in which the network begins
  /// Of `max_risk` the limit, as values are.
  std::int64_t steps = 0;

  /// What cells are judged by: a delay, an approach delay or an arrival, as the results file has them; or the
  /// bits of a risk.
  [[nodiscard]] std::int32_t value_of(std::int64_t cell) const;
};

/// Whether a cell of this value fails.
[[nodiscard]] bool fails(RequirementKind kind, std::int64_t steps, std::int32_t value);
/// The lower, the worse.
[[nodiscard]] std::int64_t rank_of(RequirementKind kind, std::int32_t value);

/// What became of it.
struct CellVerdict {
  std::int64_t cells = 0;    ///< of the region
  std::int64_t failing = 0;  ///< of these
  /// The worst value of all cells of the region; for delays kOutsideSafe, kOutsideInvariant, steps,
  /// kUnbounded. A lower bound where `max_delay` cut delays off.
  std::int32_t worst_value = 0;
  /// The failing cell with the worst value; of these that with the least collision time; then the
  /// lowest-numbered.
  std::optional<std::int64_t> worst;
};

/// The delay of a cell, as DelayLayers has them. @param collision_time its level
/// @param layers may be null: see CellRequirement
[[nodiscard]] std::int32_t delay_of(std::int64_t cell, std::int64_t collision_time,
                                    const DelayLayers* layers);

/// Of the rows of all processes. Together.
/// @param region over the same grid as the levels
/// @param number_stride [dimension]: what one index adds to a cell's number
[[nodiscard]] CellVerdict judge_cells(const CellSet& region, const UniformGrid& grid,
                                      const CellRequirement& requirement,
                                      const std::vector<std::int64_t>& number_stride, ThreadTeam& team);

}  // namespace coordreq

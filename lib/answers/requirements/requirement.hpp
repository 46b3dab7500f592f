#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/countdown/delay_layers.hpp"
#include "answers/requirements/region.hpp"
#include "answers/risk/risk.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A requirement on all cells of a region, with the levels that it is about.
struct CellRequirement {
  const LevelMap* collision_time = nullptr;  ///< Controller::levels
  RequirementKind kind = RequirementKind::invariant;
  /// Layers of its partition, of safety or of the approach; null: all agents together, who tolerate any delay
  /// in K.
  const DelayLayers* layers = nullptr;
  const LevelMap* nearness = nullptr;  ///< for requirements about arrivals
  const RiskRows* risks = nullptr;     ///< for requirements about risks: where the network starts
  /// The limit; for `max_risk` as bits, like the values.
  std::int64_t steps = 0;

  /// The value by which a cell is judged: a delay, an approach delay or an arrival, as in the results file;
  /// or the bits of a risk.
  [[nodiscard]] std::int32_t value_of(std::int64_t cell) const;
};

/// Whether a cell with this value fails.
[[nodiscard]] bool fails(RequirementKind kind, std::int64_t steps, std::int32_t value);
/// The rank of a value: the lower, the worse.
[[nodiscard]] std::int64_t rank_of(RequirementKind kind, std::int32_t value);

/// The verdict on a requirement.
struct CellVerdict {
  std::int64_t cells = 0;    ///< of the region
  std::int64_t failing = 0;  ///< cells of the region that fail
  /// The worst value of all cells of the region; for delays kOutsideSafe, kOutsideInvariant, steps,
  /// kUnbounded. A lower bound if `max_delay` cut delays off.
  std::int32_t worst_value = 0;
  /// The failing cell with the worst value; of equals the one with the least collision time, then the
  /// lowest-numbered.
  std::optional<std::int64_t> worst;
};

/// The delay of a cell, coded as in DelayLayers. @param collision_time its level
/// @param layers may be null: see CellRequirement
[[nodiscard]] std::int32_t delay_of(std::int64_t cell, std::int64_t collision_time,
                                    const DelayLayers* layers);

/// The verdict over the rows of all processes. Together.
/// @param region over the same grid as the levels
/// @param number_stride as CounterexampleProblem::number_stride
[[nodiscard]] CellVerdict judge_cells(const CellSet& region, const UniformGrid& grid,
                                      const CellRequirement& requirement,
                                      const std::vector<std::int64_t>& number_stride, ThreadTeam& team);

}  // namespace coordreq

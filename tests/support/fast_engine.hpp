#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "answers/invariance/invariance.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/layers/projections.hpp"
#include "reach/build_abstraction.hpp"

namespace coordreq {

/// All stages of the analysis that come before writing, with everything kept, for tests.
struct FastAnalysis {
  FastAnalysis(const ProblemSpec& spec, ThreadTeam& team, const PackedPairs* listed = nullptr)
      : FastAnalysis(spec, build_abstraction(spec, team), team, listed) {}
  /// @param listed the pairs of a controller file; null: there is none
  FastAnalysis(const ProblemSpec& spec, Abstraction given, ThreadTeam& team,
               const PackedPairs* listed = nullptr)
      : abstraction(std::move(given)),
        safe(safe_set(spec, abstraction, team)),
        allow(allow_table(spec, abstraction, team, listed)),
        beyond(safe_beyond_limits(spec, abstraction, safe, team)),
        engine(abstraction, allow ? &*allow : nullptr,
               TubeSets{abstraction.tubes.empty() ? nullptr : &safe, beyond ? &*beyond : nullptr}),
        hull(engine),
        invariance(find_invariance(engine, hull, safe, spec.controller.synthesis, {}, team)),
        controller{&engine, &invariance.invariant, &invariance.collision_time, spec.controller.synthesis} {
    for (const PartitionSpec& partition : spec.coordination.partitions) {
      groupings.emplace_back(engine, input_classes(spec, abstraction.inputs, partition), team);
      projections.emplace_back(controller, groupings.back(), hull, team);
      layers.push_back(find_delay_layers(engine, hull, invariance.invariant, projections.back(), {},
                                         spec.coordination.max_delay, {}, team));
    }
  }
  /// [cells], INT32_MAX in K.
  [[nodiscard]] std::vector<std::int32_t> collision_times() const {
    std::vector<std::int32_t> result;
    for (std::int64_t x = 0; x < safe.cells(); ++x) {
      const std::int64_t level = invariance.collision_time.at(x);
      result.push_back(level == LevelMap::kTop ? INT32_MAX : static_cast<std::int32_t>(level));
    }
    return result;
  }
  /// [cells] of one partition, with the values of DelayLayers for cells that have none.
  [[nodiscard]] std::vector<std::int32_t> delays(std::size_t partition) const {
    const DelayLayers& own = layers[partition];
    std::vector<std::int32_t> result;
    for (std::int64_t x = 0; x < safe.cells(); ++x) {
      const std::int64_t level = own.layers_of.at(x);
      const std::int32_t outside = safe.test(x) ? DelayLayers::kOutsideInvariant : DelayLayers::kOutsideSafe;
      result.push_back(level == LevelMap::kTop ? own.top_delay()
                       : level == 0            ? outside
                                               : static_cast<std::int32_t>(level - 1));
    }
    return result;
  }
  FastAnalysis(const FastAnalysis&) = delete;
  FastAnalysis& operator=(const FastAnalysis&) = delete;

  Abstraction abstraction;
  CellSet safe;
  std::optional<PairTable> allow;
  std::optional<CellSet> beyond;  ///< TubeSets::beyond
  RowEngine engine;
  RowHull hull;
  Invariance invariance;
  Controller controller;
  std::deque<ActionGrouping> groupings;
  std::deque<Projections> projections;
  std::vector<DelayLayers> layers;
};

}  // namespace coordreq

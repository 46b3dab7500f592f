#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "abstraction/build_abstraction.hpp"
#include "coordination/delay_layers.hpp"
#include "coordination/projections.hpp"
#include "safety/invariance.hpp"
#include "safety/safe_set.hpp"
#include "safety/safe_tubes.hpp"

namespace coordreq {

/// All stages of the analysis that come before writing, with everything kept, for tests.
struct FastAnalysis {
  FastAnalysis(const ProblemSpec& spec, ThreadTeam& team)
      : FastAnalysis(spec, build_abstraction(spec, team), team) {}
  FastAnalysis(const ProblemSpec& spec, Abstraction given, ThreadTeam& team)
      : abstraction(std::move(given)),
        safe(safe_set(spec, abstraction, team)),
        allow(allow_table(spec, abstraction, team)),
        beyond(safe_beyond_limits(spec, abstraction, safe, team)),
        engine(abstraction, allow ? &*allow : nullptr,
               SafeTubes{abstraction.tubes.empty() ? nullptr : &safe, beyond ? &*beyond : nullptr}, team),
        reach(engine),
        invariance(find_invariance(engine, reach, safe, spec.controller.synthesis, {}, team)),
        target(engine.target(invariance.invariant, team)),
        controller{&engine, &target, spec.controller.synthesis} {
    for (const PartitionSpec& partition : spec.coordination.partitions) {
      std::vector<InputClass> classes;
      for (const auto& agents : partition.classes) {
        InputClass& inputs = classes.emplace_back();
        for (const std::int32_t agent : agents) {
          const auto& own = spec.agents[static_cast<std::size_t>(agent)].inputs;
          inputs.insert(inputs.end(), own.begin(), own.end());
        }
      }
      groupings.emplace_back(engine, classes, team);
      const Projections projections(controller, groupings.back(), team);
      layers.push_back(find_delay_layers(engine, reach, safe, invariance.invariant, projections,
                                         spec.coordination.max_delay, {}, team));
    }
  }
  FastAnalysis(const FastAnalysis&) = delete;
  FastAnalysis& operator=(const FastAnalysis&) = delete;

  Abstraction abstraction;
  CellSet safe;
  std::optional<ConditionTable> allow;
  std::optional<CellSet> beyond;  ///< SafeTubes::beyond
  RowEngine engine;
  RowReach reach;
  Invariance invariance;
  RowTarget target;
  Controller controller;
  std::deque<ActionGrouping> groupings;
  std::vector<DelayLayers> layers;
};

}  // namespace coordreq

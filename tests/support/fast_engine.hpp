#pragma once

#include <deque>
#include <memory>
#include <utility>

#include "answers/answers.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/plan.hpp"
#include "answers/step_codes.hpp"
#include "choices/controller.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The plan of the program on an abstraction of the states in the order of the spec, with what can be asked
/// of it near at hand.
struct FastAnalysis {
  FastAnalysis(const ProblemSpec& spec, ThreadTeam& team, const PackedPairs* listed = nullptr)
      : FastAnalysis(spec, build_abstraction(spec, team), team, listed) {}
  /// @param listed the pairs of a controller file; null: there is none
  FastAnalysis(const ProblemSpec& spec, Abstraction given, ThreadTeam& team,
               const PackedPairs* listed = nullptr)
      : model(make_model(spec)),
        answers(found(model, std::move(given), team, listed)),
        abstraction(*answers->context.abstraction),
        safe(answers->context.safe),
        beyond(answers->context.beyond),
        engine(*answers->context.engine),
        hull(*answers->context.hull),
        invariance(answers->get<Invariance>()),
        controller(answers->get<Controller>()),
        layers(answers->get<PartitionLayers>().partitions) {
    for (std::size_t p = 0; p < layers.size(); ++p) actions.emplace_back(*answers, p, team);
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
      const std::int32_t outside = safe.test(x) ? kOutsideInvariant : kOutsideSafe;
      result.push_back(level == LevelMap::kTop ? own.top_delay()
                       : level == 0            ? outside
                                               : static_cast<std::int32_t>(level - 1));
    }
    return result;
  }
  FastAnalysis(const FastAnalysis&) = delete;
  FastAnalysis& operator=(const FastAnalysis&) = delete;

  Model model;
  std::unique_ptr<Answers> answers;
  const Abstraction& abstraction;
  const CellSet& safe;
  const std::optional<CellSet>& beyond;  ///< TubeSets::beyond
  const RowEngine& engine;
  const RowHull& hull;
  const Invariance& invariance;
  const Controller& controller;
  const std::vector<DelayLayers>& layers;
  std::deque<PartitionActions> actions;  ///< of each partition

 private:
  static std::unique_ptr<Answers> found(const Model& model, Abstraction given, ThreadTeam& team,
                                        const PackedPairs* listed) {
    auto result = std::make_unique<Answers>(model);
    AnalysisContext& context = result->context;
    if (listed != nullptr) context.listed = ListedController{.pairs = *listed};
    context.abstraction = std::move(given);
    std::vector<Stage> stages = answer_stages(model.spec());
    stages.erase(stages.begin());  // "abstraction", which is there already
    run_stages(stages, *result, {.team = team});
    return result;
  }
};

}  // namespace coordreq

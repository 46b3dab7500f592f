#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>
#include <string>

#include "answers/goal/answer.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/goal/fields.hpp"
#include "answers/invariance/safe_set.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/plain_goal.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// Often met, sometimes nowhere or everywhere.
std::string draw_goal(std::size_t states) {
  const auto name = [&] { return "x" + std::to_string(*rc::gen::inRange<std::size_t>(0, states)); };
  const auto bound = [] { return std::to_string(*rc::gen::inRange(0, 6)) + ".5"; };
  const std::string one = name() + *rc::gen::element<std::string>(" <= ", " >= ") + bound();
  const std::string two = name() + *rc::gen::element<std::string>(" <= ", " >= ") + bound();
  return *rc::gen::weightedElement<std::string>(
      {{6, one}, {3, one + " and " + two}, {2, one + " or " + two}, {1, "false"}, {1, "true"}});
}

/// A random problem with a goal; some of its `safe` sides are `goal` sides. Most cells are half open: in
/// closed ones a step of one cell does not come nearer.
std::string draw_goal_problem(RandomTime time) {
  const RandomAgents agents = *rc::gen::element(RandomAgents::few, RandomAgents::many);
  nlohmann::json spec = nlohmann::json::parse(draw_problem(time, RandomEdges::any, agents));
  if (*rc::gen::inRange(0, 5) > 0) spec["abstraction"]["cells"] = "half_open";
  if (*rc::gen::inRange(0, 3) > 0) spec["disturbances"] = nlohmann::json::array();
  for (nlohmann::json& equation : spec["dynamics"]["equations"]) {
    if (spec["disturbances"].empty() && equation.get<std::string>().find('w') != std::string::npos)
      spec["disturbances"].push_back({{"name", "w"}, {"lower", 0}, {"upper", 0}});
  }
  spec["goal"] = draw_goal(spec["states"].size());
  const int share = *rc::gen::inRange(0, 3);
  for (nlohmann::json& state : spec["states"]) {
    if (!state.contains("outside") || !state["outside"].is_object()) continue;
    for (nlohmann::json& side : state["outside"]) {
      if (side == "safe" && *rc::gen::inRange(0, 2) < share) side = "goal";
    }
  }
  return spec.dump();
}

std::vector<std::int32_t> arrivals(const FastAnalysis& fast, const Goal& goal) {
  std::vector<std::int32_t> result;
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
    const bool is_invariant = fast.invariance.invariant.test(x);
    result.push_back(is_invariant ? arrival_at(goal.nearness, x) : fast.safe.test(x) ? -1 : -2);
  }
  return result;
}

std::vector<std::int32_t> approach_delays(const FastAnalysis& fast, const Goal& goal, std::size_t p) {
  const DelayLayers& own = goal.approach[p];
  std::vector<std::int32_t> result;
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
    const std::int64_t level = own.layers_of.at(x);
    const bool is_invariant = fast.invariance.invariant.test(x);
    const std::int32_t outside = is_invariant ? kOutsideWinning : fast.safe.test(x) ? -1 : -2;
    result.push_back(level == LevelMap::kTop ? own.top_delay()
                     : level == 0            ? outside
                                             : static_cast<std::int32_t>(level - 1));
  }
  return result;
}

/// P of all joint inputs, with C in the goal.
std::vector<std::vector<bool>> progress(const FastAnalysis& fast, ThreadTeam& team) {
  const std::unique_ptr<const ControllerParts> parts = controller_parts(*fast.answers, true);
  std::vector<std::vector<bool>> result;
  for (const PartialController& part : parts->parts) {
    const ActionGrouping grouping(*part.controller.engine, {whole_class(fast.abstraction.inputs)}, team);
    const auto bytes = static_cast<std::size_t>(grouping[0].bytes());
    const auto actions = static_cast<std::size_t>(grouping[0].actions());
    const auto packed = action_bits(part.controller, grouping, 0, 0, fast.engine.rows());
    result.resize(packed.size() / bytes, std::vector<bool>(actions, false));
    for (std::size_t x = 0; x < result.size(); ++x) {
      for (std::size_t a = 0; a < actions; ++a)
        result[x][a] = result[x][a] || (packed[x * bytes + a / 8] >> (a % 8) & 1) != 0;
    }
  }
  return result;
}

void expect_goal(const ProblemSpec& spec, ThreadTeam& team) {
  const FastAnalysis fast(spec, team);
  const Goal& goal = fast.answers->get<Goal>();
  const CellSet satisfying =
      cells_that_satisfy(*spec.goal, spec, fast.abstraction.grid, fast.abstraction.inputs, team);
  const PlainAnalysis safety = plainly(spec, fast);
  const PlainGoal plain =
      reach_goal_plainly(spec, fast.abstraction, members(fast.safe), members(fast.beyond.value_or(fast.safe)),
                         safety, members(satisfying));
  RC_ASSERT(arrivals(fast, goal) == plain.arrival);
  RC_ASSERT(progress(fast, team) == plain.progress);
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    RC_ASSERT(approach_delays(fast, goal, p) == plain.partitions[p].delay);
    RC_ASSERT(goal.approach[p].sizes == plain.partitions[p].sizes);
    RC_ASSERT(goal.approach[p].fixed_point_index == plain.partitions[p].fixed_point_index);
    RC_ASSERT(goal.approach[p].truncated == plain.partitions[p].truncated);
  }
  RC_CLASSIFY(goal.away.count() > 0, "cells that come nearer");
  RC_CLASSIFY(longest_arrival(goal.nearness, team).value_or(0) > 2, "more than two steps to the goal");
  RC_CLASSIFY(goal.approach[0].sizes.size() > 1, "more than one approach layer");
  RC_CLASSIFY(has_safe_side(spec), "a safe side");
  RC_CLASSIFY(goal.approach[0].truncated, "truncated");
}

TEST(Goals, RowsAndSinglePairsGiveTheSameBits) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("goals of the row engine equal those of the plain one", [&] {
    const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
    expect_goal(read_spec(draw_goal_problem(time), "random"), team);
  }));
}

}  // namespace
}  // namespace coordreq

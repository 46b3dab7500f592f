#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "answers/countdown/leaving_cells.hpp"
#include "answers/goal/answer.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "cell/closed_loop.hpp"
#include "cell/margin.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/plain_goal.hpp"
#include "support/plain_posts.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// A random problem with a goal; some of its `safe` sides are `goal` sides. Most cells are half open: in
/// closed ones a step of one cell does not come nearer.
std::string draw_goal_problem(RandomTime time, const std::vector<std::string>& thens = {"safe", "over"}) {
  const RandomAgents agents = *rc::gen::element(RandomAgents::few, RandomAgents::many);
  nlohmann::json spec = nlohmann::json::parse(draw_problem(time, RandomEdges::any, agents));
  if (*rc::gen::inRange(0, 5) > 0) spec["abstraction"]["cells"] = "half_open";
  if (*rc::gen::inRange(0, 3) > 0) spec["disturbances"] = nlohmann::json::array();
  for (nlohmann::json& equation : spec["dynamics"]["equations"]) {
    if (spec["disturbances"].empty() && equation.get<std::string>().find('w') != std::string::npos)
      spec["disturbances"].push_back({{"name", "w"}, {"lower", 0}, {"upper", 0}});
  }
  spec["goal"] = draw_goal(spec["states"]);
  const std::string then = *rc::gen::elementOf(thens);
  if (then != "safe") spec["goal"] = {{"where", spec["goal"]}, {"then", then}};
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
  const std::unique_ptr<const PiecewiseController> pieces = piecewise_controller(*fast.answers, true);
  std::vector<std::vector<bool>> result;
  for (const PartialController& part : pieces->pieces) {
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

/// Some side of the domain is a way to arrive.
bool has_goal_side(const ProblemSpec& spec) {
  return std::ranges::any_of(spec.states, [](const StateSpec& state) {
    return state.below == Outside::goal || state.above == Outside::goal;
  });
}

/// Plain reach-avoid, which knows nothing of K: how soon agents can be in the goal at the latest without ever
/// leaving S before, by the least fixed point over S. A goal that ends the task is that.
std::vector<std::int32_t> reach_avoid(const ProblemSpec& spec, const FastAnalysis& fast,
                                      const PlainAnalysis& plain) {
  const std::vector<bool> safe = members(fast.safe), beyond = members(fast.beyond.value_or(fast.safe));
  const PlainPosts posts{fast.abstraction, safe, beyond};
  const UniformGrid& grid = fast.abstraction.grid;
  const auto leaves_for_nothing = [&](std::int64_t x, std::int64_t u) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const IndexRange raw = fast.abstraction.raw(i, x, u);
      if (raw.first < 0 && grid[i].below == Outside::safe) return true;
      if (raw.last >= grid[i].count && grid[i].above == Outside::safe) return true;
    }
    return false;
  };
  std::vector<bool> reached = plain.terminal;
  std::vector<std::int32_t> steps(reached.size(), INT32_MAX);
  for (std::int32_t k = 0;; ++k) {
    for (std::size_t x = 0; x < steps.size(); ++x) {
      if (reached[x] && steps[x] == INT32_MAX) steps[x] = k;
    }
    std::vector<bool> next = reached;
    for (std::int64_t x = 0; x < grid.cells(); ++x) {
      const auto here = static_cast<std::size_t>(x);
      bool some = false, every = true;
      for (std::int64_t u = 0; u < fast.abstraction.inputs.count(); ++u) {
        if (!plain.permitted[here][static_cast<std::size_t>(u)]) continue;
        const bool comes = !leaves_for_nothing(x, u) && posts.stays_in(x, u, reached);
        some = some || comes;
        every = every && comes;
      }
      const bool is_given = spec.controller.synthesis == Synthesis::given;
      next[here] = next[here] || (safe[here] && some && (every || !is_given));
    }
    if (next == reached) return steps;
    reached = std::move(next);
  }
}

void expect_reach_avoid(const ProblemSpec& spec, const FastAnalysis& fast, const PlainAnalysis& plain) {
  const std::vector<std::int32_t> steps = reach_avoid(spec, fast, plain);
  const std::vector<std::int32_t> found = arrivals(fast, fast.answers->get<Goal>());
  for (std::size_t x = 0; x < steps.size(); ++x) RC_ASSERT((found[x] < 0 ? INT32_MAX : found[x]) == steps[x]);
}

void expect_goal(const ProblemSpec& spec, ThreadTeam& team) {
  const FastAnalysis fast(spec, team);
  const Goal& goal = fast.answers->get<Goal>();
  const CellSet satisfying =
      cells_that_satisfy(*spec.goal, spec, fast.abstraction.grid, fast.abstraction.inputs, team);
  const PlainAnalysis safety = plainly(spec, fast);
  if (spec.ends_at_goal()) expect_agreement(fast, safety, team);
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
  RC_ASSERT(goal.returns.forced == plain.longest_return);
  RC_ASSERT(goal.returns.any_choice == plain.longest_gap);
  bool some_not_kept = false;
  for (std::size_t x = 0; x < plain.arrival.size(); ++x)
    some_not_kept = some_not_kept || (plain.arrival[x] > 0 && goal.cells.test(static_cast<std::int64_t>(x)));
  RC_CLASSIFY(some_not_kept, "cells of the goal that do not count as arrived");
  RC_CLASSIFY(goal.outside_goal.count() > 0, "cells that come nearer");
  RC_CLASSIFY(longest_arrival(goal.nearness, team).value_or(0) > 2, "more than two steps to the goal");
  RC_CLASSIFY(goal.approach[0].sizes.size() > 1, "more than one approach layer");
  RC_CLASSIFY(has_safe_side(spec), "a safe side");
  RC_CLASSIFY(goal.approach[0].truncated, "truncated");
  if (!spec.ends_at_goal()) return;
  expect_reach_avoid(spec, fast, safety);
  const std::vector<bool> terminal = members(goal.cells);
  bool some_blocked = false;
  for (std::size_t x = 0; x < terminal.size(); ++x) {
    const std::vector<bool>& own = safety.controller[x];
    some_blocked = some_blocked || (terminal[x] && std::find(own.begin(), own.end(), true) == own.end());
  }
  RC_CLASSIFY(some_blocked, "cells of the goal without an action");
}

TEST(Goals, ToStayAtAndToReturnToAreThoseOfNestedLoops) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("lasting goals of the row engine equal those of the plain one", [&] {
    const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
    expect_goal(read_spec(draw_goal_problem(time, {"stay", "return"}), "random"), team);
  }));
}

TEST(Goals, RowsAndSinglePairsGiveTheSameBits) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("goals of the row engine equal those of the plain one", [&] {
    const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
    expect_goal(read_spec(draw_goal_problem(time), "random"), team);
  }));
}

/// The goal's condition at the true state of a sample, as far as doubles tell.
bool is_in_goal(const ProblemSpec& spec, const RunTrace::Sample& sample) {
  std::vector<Rational> slots(spec.slot_count());
  for (std::size_t i = 0; i < sample.state.size(); ++i) slots[spec.state_slot(i)] = exact(sample.state[i]);
  return Margin(*spec.goal).value(slots) > -1e-9;
}

void expect_end(const ProblemSpec& spec, const RunTrace& trace) {
  RC_ASSERT(!is_violation(trace.outcome));
  const std::int32_t promised = trace.samples.front().arrival;
  const auto steps = static_cast<std::int32_t>(trace.steps.size());
  if (promised <= 12) RC_ASSERT(trace.outcome == Outcome::reached_goal && steps <= promised);
  RC_ASSERT(trace.arrived.has_value() == (trace.outcome == Outcome::reached_goal));
  if (!trace.arrived) return;
  RC_ASSERT(*trace.arrived == steps);
  // Beyond a `goal` side no cell tells, and of centres nothing is said of the states about them.
  if (spec.abstraction.safe == Membership::inner && !has_goal_side(spec))
    RC_ASSERT(is_in_goal(spec, trace.samples.back()));
}

TEST(Goals, RunsEndInTheGoalThatEndsTheTaskAndInTime) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("runs of all policies", [&] {
    nlohmann::json text = nlohmann::json::parse(draw_goal_problem(RandomTime::any));
    if (text["goal"].is_string()) text["goal"] = {{"where", text["goal"]}, {"then", "over"}};
    const ProblemSpec spec = read_spec(text.dump(), "random");
    const FastAnalysis fast(spec, team);
    const Goal& goal = fast.answers->get<Goal>();
    if (fast.invariance.cells == 0) return;
    const std::vector<std::int32_t> arrival = arrivals(fast, goal);
    std::vector<AnswerPolicy> policies = layer_policies(spec);
    for (const AnswerPolicy& policy : goal_policies(spec)) policies.push_back(policy);
    bool some_arrive = false;
    for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p) {
      const std::vector<std::int32_t> delay = fast.delays(p), approach = approach_delays(fast, goal, p);
      const LoopProblem problem{
          .spec = &spec,
          .abstraction = &fast.abstraction,
          .partition = &spec.coordination.partitions[p],
          .policies = policies,
          .values = {{paths::kDelay, delay}, {paths::kApproachDelay, approach}, {paths::kArrival, arrival}},
          .safe_beyond = fast.beyond ? &*fast.beyond : nullptr,
          .connection_delay = spec.coordination.connection_delay};
      for (const Policy policy : {Policy::random, Policy::adversarial}) {
        const LoopOptions options{
            .steps = 12, .policy = policy, .disturbance = Disturbance::extremes, .seed = p, .runs = 6};
        for (const RunTrace& trace : simulate_runs(problem, options, team)) {
          expect_end(spec, trace);
          some_arrive = some_arrive || (trace.arrived && !trace.steps.empty());
        }
      }
    }
    RC_CLASSIFY(some_arrive, "runs that arrive");
  }));
}

/// Rows hold the same cells of S, and their tables say the same; only in one of them a cell is the end.
TEST(Goals, ThatEndTheTaskTellRowsApartThatAreAlikeInAllElse) {
  ThreadTeam team(2);
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "alike",
    "states": [{"name": "y", "lower": 0, "upper": 39, "step": 1, "discrete": true, "outside": "saturate"},
               {"name": "x", "lower": 0, "upper": 9, "step": 1, "discrete": true}],
    "inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"y": "y", "x": "if(x == 0, -1, x - abs(u - v))"}},
    "safe": "true", "goal": {"where": "y == 7 and x == 0", "then": "over"}})json",
                                     "alike");
  const FastAnalysis fast(spec, team);
  ASSERT_TRUE(fast.answers->context.tiles.has_value());
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
    const bool is_at_goal = x / 10 == 7;
    EXPECT_EQ(fast.invariance.invariant.test(x), is_at_goal || x % 10 > 0) << x;
    EXPECT_EQ(fast.delays(0)[static_cast<std::size_t>(x)], is_at_goal ? INT32_MAX : x % 10 - 1) << x;
  }
}

/// Two that could change places, if only one of them had not to arrive.
TEST(Goals, OfOneAgentMakeItAnother) {
  ThreadTeam team(2);
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "race",
    "states": [{"name": "p", "lower": 0, "upper": 5, "step": 1, "discrete": true},
               {"name": "q", "lower": 0, "upper": 5, "step": 1, "discrete": true},
               {"name": "c", "lower": 0, "upper": 1, "step": 1, "discrete": true, "outside": "saturate"}],
    "inputs": [{"name": "u", "values": [1, 2]}, {"name": "v", "values": [1, 2]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"p": "p - u", "q": "q - v", "c": "c"}},
    "safe": "true", "goal": {"where": "p == 0", "then": "over"}})json",
                                     "race");
  const FastAnalysis fast(spec, team);
  EXPECT_TRUE(fast.answers->context.like_agents.empty());
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
    const std::int64_t p = x / 12, q = x / 2 % 6;
    EXPECT_EQ(fast.invariance.invariant.test(x), q >= (p + 1) / 2) << x;
  }
}

}  // namespace
}  // namespace coordreq

#include "answers/goal/lasting_goal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "answers/goal/answer.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/step_codes.hpp"
#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"
#include "support/members.hpp"
#include "support/plain_goal.hpp"

namespace coordreq::lasting_goals {
namespace {

using Steps = std::vector<std::int32_t>;
using Sizes = std::vector<std::int64_t>;

/// A state p of 0, ..., last, two agents with an input each, u and v.
struct Game {
  int last;
  std::string next;  ///< of p
  std::string goal;
  std::string then;
  nlohmann::json u = {0, 1};
  nlohmann::json more = nlohmann::json::object();  ///< keys of the spec
  nlohmann::json outside = "saturate";
  nlohmann::json disturbances = nlohmann::json::array();

  [[nodiscard]] ProblemSpec spec() const {
    nlohmann::json json = {
        {"coordreq", 1},
        {"name", "game"},
        {"states", {{{"name", "p"}, {"lower", 0}, {"upper", last}, {"step", 1}, {"outside", outside}}}},
        {"inputs", {{{"name", "u"}, {"values", u}}, {{"name", "v"}, {"values", {0, 1}}}}},
        {"agents", {{{"name", "a"}, {"inputs", {"u"}}}, {{"name", "b"}, {"inputs", {"v"}}}}},
        {"dynamics", {{"time", "discrete"}, {"period", 1}, {"equations", {{"p", next}}}}},
        {"safe", "true"},
        {"goal", {{"where", goal}, {"then", then}}}};
    if (disturbances.empty()) {
      json["states"][0]["discrete"] = true;
    } else {
      json["disturbances"] = disturbances;
      json["abstraction"] = {{"cells", "half_open"}, {"safe", "center"}};
    }
    json.update(more);
    return read_spec(json.dump(), "game");
  }
};

/// What the row engine and the plain one find, if they agree.
PlainGoal found(const Game& game) {
  ThreadTeam team(2);
  const ProblemSpec spec = game.spec();
  const FastAnalysis fast(spec, team);
  const Goal& goal = fast.answers->get<Goal>();
  const std::vector<bool> safe = members(fast.safe);
  const std::vector<bool> satisfying =
      members(cells_that_satisfy(*spec.goal, spec, fast.abstraction.grid, fast.abstraction.inputs, team));
  const std::vector<bool> beyond = members(fast.beyond.value_or(fast.safe));
  const PlainAnalysis safety = analyze_plainly(spec, fast.abstraction, safe, beyond);
  const PlainGoal plain = reach_goal_plainly(spec, fast.abstraction, safe, beyond, safety, satisfying);
  for (std::size_t x = 0; x < plain.arrival.size(); ++x) {
    const auto cell = static_cast<std::int64_t>(x);
    EXPECT_EQ(arrival_at(goal.nearness, cell), plain.arrival[x]) << cell;
    const std::int64_t level = goal.approach[0].layers_of.at(cell);
    const std::int32_t delay = level == LevelMap::kTop ? goal.approach[0].top_delay()
                               : level == 0            ? kOutsideWinning
                                                       : static_cast<std::int32_t>(level - 1);
    EXPECT_EQ(delay, plain.partitions[0].delay[x]) << cell;
  }
  EXPECT_EQ(goal.approach[0].sizes, plain.partitions[0].sizes);
  EXPECT_EQ(goal.approach[0].fixed_point_index, plain.partitions[0].fixed_point_index);
  EXPECT_EQ(goal.returns.forced, plain.longest_return);
  EXPECT_EQ(goal.returns.any_choice, plain.longest_gap);
  return plain;
}

Game line(const std::string& then, const nlohmann::json& u) {
  return {.last = 4, .next = "p + u", .goal = "p == 3", .then = then, .u = u};
}

TEST(LastingGoals, OnALineAreLeftAndVisitedAgain) {
  const PlainGoal stay = found(line("stay", {-1, 0, 1}));
  EXPECT_EQ(stay.arrival, Steps({3, 2, 1, 0, 1}));
  const PlainGoal back = found(line("return", {-1, 0, 1}));
  EXPECT_EQ(back.arrival, Steps({3, 2, 1, 0, 1}));
  EXPECT_EQ(back.longest_return, 1);
  EXPECT_EQ(back.longest_gap, 2);
  EXPECT_EQ(back.partitions[0].delay, Steps(5, kUnbounded));
  EXPECT_EQ(back.partitions[0].sizes, Sizes({5}));
}

TEST(LastingGoals, ThatCannotBeKeptCanBeVisited) {
  const PlainGoal stay = found(line("stay", {-1, 1}));
  EXPECT_EQ(stay.arrival, Steps(5, kUnbounded));
  EXPECT_EQ(stay.partitions[0].delay, Steps(5, kOutsideWinning));
  EXPECT_EQ(stay.partitions[0].sizes, Sizes({0}));
  const PlainGoal back = found(line("return", {-1, 1}));
  EXPECT_EQ(back.arrival, Steps({3, 2, 1, 0, 1}));
  EXPECT_EQ(back.longest_return, 2);
  EXPECT_EQ(back.longest_gap, 2);
}

/// From 0 the world may stay in the goal for ever, or go on to 1 and so to 2.
TEST(LastingGoals, CountSamplesWhereTheWorldDecidesWhenToMoveOn) {
  const Game game{.last = 2,
                  .next = "if(p < 0.5, d, 2)",
                  .goal = "p == 0 or p == 2",
                  .then = "stay",
                  .disturbances = {{{"name", "d"}, {"lower", 0}, {"upper", 1}}}};
  const PlainGoal stay = found(game);
  EXPECT_EQ(stay.arrival, Steps({1, 1, 0}));
  EXPECT_EQ(stay.partitions[0].delay, Steps(3, kUnbounded));
}

/// Many such choices in a row, each known only when the next one is.
TEST(LastingGoals, CountSamplesOverManyChoicesOfTheWorld) {
  constexpr int kLast = 24;
  std::string even;  // cells at which the world may wait
  for (int p = 0; p <= kLast; p += 2) even += fmt::format("{}p == {}", p == 0 ? "" : " or ", p);
  const Game game{.last = kLast,
                  .next = fmt::format("min(p + 1 - if({}, d, 0), {})", even, kLast),
                  .goal = even,
                  .then = "stay",
                  .disturbances = {{{"name", "d"}, {"lower", 0}, {"upper", 1}}}};
  const PlainGoal stay = found(game);
  for (int p = 0; p <= kLast; ++p)
    EXPECT_EQ(stay.arrival[static_cast<std::size_t>(p)], (kLast - p + 1) / 2) << p;
}

Game meeting(const std::string& then, const nlohmann::json& max_delay) {
  return {.last = 3,
          .next = "if(p == 3, 2, if(p == 2, if(u == v, 3, 1), p + 1))",
          .goal = "p >= 2",
          .then = then,
          .more = {{"coordination", {{"max_delay", max_delay}}}}};
}

TEST(LastingGoals, HaveLayersInTheGoalToo) {
  const PlainGoal stay = found(meeting("stay", nullptr));
  EXPECT_EQ(stay.arrival, Steps({2, 1, 0, 0}));
  EXPECT_EQ(stay.partitions[0].delay, Steps({2, 1, 0, 1}));
  EXPECT_EQ(stay.partitions[0].sizes, Sizes({4, 3, 1, 0}));
  EXPECT_EQ(stay.partitions[0].fixed_point_index, 3);
  const PlainGoal limited = found(meeting("stay", 1));
  EXPECT_EQ(limited.partitions[0].delay, Steps({1, 1, 0, 1}));
  EXPECT_EQ(limited.partitions[0].sizes, Sizes({4, 3}));
  EXPECT_EQ(limited.partitions[0].fixed_point_index, -1);
  EXPECT_EQ(found(meeting("stay", 0)).partitions[0].sizes, Sizes({4}));
  const PlainGoal back = found(meeting("return", nullptr));
  EXPECT_EQ(back.arrival, Steps({2, 1, 0, 0}));
  EXPECT_EQ(back.partitions[0].delay, Steps(4, kUnbounded));
  EXPECT_EQ(back.longest_return, 1);
  EXPECT_EQ(back.longest_gap, 2);
}

TEST(LastingGoals, MixTheProjectionsOfWhatKeeps) {
  const Game game{.last = 4,
                  .next = "if(u == v, if(p < 3, p + 1, 3), if(p > 0, p - 1, 0))",
                  .goal = "p == 3",
                  .then = "stay"};
  const PlainGoal stay = found(game);
  EXPECT_EQ(stay.arrival, Steps({3, 2, 1, 0, 1}));
  EXPECT_EQ(stay.partitions[0].delay, Steps({0, 0, 0, 0, 1}));
  EXPECT_EQ(stay.partitions[0].sizes, Sizes({5, 1, 0}));
  EXPECT_EQ(stay.partitions[0].fixed_point_index, 2);
}

TEST(LastingGoals, AreFulfilledBeyondAGoalSideAlone) {
  Game game{.last = 2,
            .next = "p + if(u == v, 1, -1)",
            .goal = "false",
            .then = "stay",
            .outside = {{"below", "safe"}, {"above", "goal"}}};
  const PlainGoal stay = found(game);
  EXPECT_EQ(stay.arrival, Steps({3, 2, 1}));
  EXPECT_EQ(stay.partitions[0].delay, Steps({0, 0, 0}));
  EXPECT_EQ(stay.partitions[0].sizes, Sizes({3, 0}));
  game.goal = "p == 0";
  game.then = "return";
  const PlainGoal back = found(game);
  EXPECT_EQ(back.arrival, Steps({0, 1, 1}));
  EXPECT_EQ(back.partitions[0].sizes, Sizes({3, 0}));
  EXPECT_EQ(back.longest_return, 2);
  EXPECT_EQ(back.longest_gap, 2);
}

TEST(LastingGoals, AndOthersHaveAllOfWWhereNoStepCounts) {
  for (const char* then : {"safe", "over", "stay", "return"}) {
    for (const char* goal : {"false", "p == 2"}) {
      const PlainGoal none = found({.last = 2,
                                    .next = "p + if(u == v, 1, -1)",
                                    .goal = goal,
                                    .then = then,
                                    .more = {{"coordination", {{"max_delay", 0}}}},
                                    .outside = {{"below", "safe"}, {"above", "goal"}}});
      EXPECT_EQ(none.partitions[0].delay, Steps({0, 0, 0})) << then;
      EXPECT_EQ(none.partitions[0].sizes, Sizes({3})) << then;
      EXPECT_EQ(none.partitions[0].fixed_point_index, -1) << then;
    }
  }
}

TEST(LastingGoals, OfAGivenControllerAreWhatItDoesInAnyCase) {
  Game game = line("return", {-1, 0, 1});
  game.more = {{"controller",
                {{"synthesis", "given"},
                 {"allow", "(p < 3 and u >= 0) or (p == 3 and u == 0) or (p == 4 and u == -1)"}}}};
  const PlainGoal back = found(game);
  EXPECT_EQ(back.arrival, Steps({kUnbounded, kUnbounded, kUnbounded, 0, 1}));
  EXPECT_EQ(back.partitions[0].sizes, Sizes({2}));
  EXPECT_EQ(back.longest_return, 1);
  EXPECT_EQ(back.longest_gap, 1);
  game.then = "stay";
  EXPECT_EQ(found(game).arrival, Steps({kUnbounded, kUnbounded, kUnbounded, 0, 1}));
  game.then = "return";
  game.more["controller"]["allow"] = "(p < 3 and u == 1) or (p == 3 and u != 0) or (p == 4 and u == -1)";
  const PlainGoal forward = found(game);
  EXPECT_EQ(forward.arrival, Steps({3, 2, 1, 0, 1}));
  EXPECT_EQ(forward.longest_return, 2);
  EXPECT_EQ(forward.longest_gap, 2);
}

TEST(LastingGoals, AreNowhereIfTheWorldCanLeaveThemForGood) {
  for (const std::string then : {"stay", "return"}) {
    const Game game{.last = 1,
                    .next = "if(p < 0.5, d, 1)",
                    .goal = "p == 0",
                    .then = then,
                    .disturbances = {{{"name", "d"}, {"lower", 0}, {"upper", 1}}}};
    const PlainGoal trap = found(game);
    EXPECT_EQ(trap.arrival, Steps({kUnbounded, kUnbounded})) << then;
    EXPECT_EQ(trap.partitions[0].sizes, Sizes({0})) << then;
    EXPECT_FALSE(trap.longest_return.has_value()) << then;
  }
}

/// 253 samples are the most that 8 bits hold.
TEST(LastingGoals, CountBeyondEightBits) {
  for (const std::string then : {"stay", "return"}) {
    const Game game{.last = 300, .next = "p - u", .goal = "p == 0", .then = then};
    const PlainGoal far = found(game);
    for (int p = 0; p <= 300; ++p) EXPECT_EQ(far.arrival[static_cast<std::size_t>(p)], p) << then;
  }
}

}  // namespace
}  // namespace coordreq::lasting_goals

// Points on a line that agents push: small enough to compute by hand what agents with rules do.

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "base/json.hpp"
#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"

namespace coordreq {
namespace {

using Silences = std::vector<std::int32_t>;

constexpr std::int32_t kForGood = kUnbounded;

/// x and y in 0, ..., 4, of which a moves the one and b the other; both have to stay.
SortedJson two_points(const SortedJson& silence) {
  SortedJson spec = SortedJson::parse(R"({"coordreq": 1, "name": "points",
"states": [{"name": "x", "lower": 0, "upper": 4, "step": 1, "discrete": true},
           {"name": "y", "lower": 0, "upper": 1, "step": 1, "discrete": true, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}}, "safe": "true"})");
  spec["silence"] = silence;
  return spec;
}

/// Where y is 0, by x; and for how many cells each agent is why no agent can do anything.
struct Result {
  Silences silence;
  std::vector<std::int64_t> without_action;
};

Result found(const SortedJson& json) {
  ThreadTeam team(1);
  const ProblemSpec spec = read_spec(json.dump(), "case");
  const FastAnalysis fast(spec, team);
  const SilencePartition& silence = silence_of(*fast.answers, 0);
  Result result{{}, silence.without_action};
  for (std::int64_t x = 0; x < fast.safe.cells(); x += 2) {
    const std::int64_t level = silence.layers.layers_of.at(x);
    result.silence.push_back(level == LevelMap::kTop ? silence.layers.top_delay()
                                                     : static_cast<std::int32_t>(level - 1));
  }
  return result;
}

Silences silence_by(const SortedJson& actions) {
  return found(two_points({{"actions", actions}})).silence;
}

TEST(SilenceHandCases, EndsWhereAnUnsafeSideIsReached) {
  EXPECT_EQ(silence_by({{"a", "u == 1"}, {"b", "true"}}), (Silences{4, 3, 2, 1, 0}));
  EXPECT_EQ(silence_by({{"a", "u >= 0"}, {"b", "true"}}), (Silences{4, 3, 2, 1, 0}));
  EXPECT_EQ(silence_by({{"a", "true"}, {"b", "true"}}), (Silences{0, 1, 2, 1, 0}));
  EXPECT_EQ(silence_by({{"a", "u == 0"}, {"b", "true"}}),
            (Silences{kForGood, kForGood, kForGood, kForGood, kForGood}));
}

TEST(SilenceHandCases, ConditionsMayReadWhereTheAgentIs) {
  EXPECT_EQ(silence_by({{"a", "u == if(x >= 2, 1, -1)"}, {"b", "true"}}), (Silences{0, 1, 2, 1, 0}));
  EXPECT_EQ(silence_by({{"a", "u == if(x >= 2, -1, 1)"}, {"b", "v == 0"}}),
            (Silences{kForGood, kForGood, kForGood, kForGood, kForGood}));
}

TEST(SilenceHandCases, WithoutARuleAnAgentStaysWhereTheControllerKeepsIt) {
  EXPECT_EQ(silence_by({{"b", "true"}}), (Silences{kForGood, kForGood, kForGood, kForGood, kForGood}));
}

TEST(SilenceHandCases, WhereSomebodyIsToldNothingThereIsNone) {
  const Result nothing = found(two_points({{"actions", {{"a", "u == 1 and x != 2"}, {"b", "true"}}}}));
  EXPECT_EQ(nothing.silence, (Silences{2, 1, 0, 1, 0}));
  EXPECT_EQ(nothing.without_action, (std::vector<std::int64_t>{2, 0}));  // y is 0 or 1
  const Result second = found(two_points({{"actions", {{"a", "u == 1"}, {"b", "v == 0 and (x + y) != 3"}}}}));
  EXPECT_EQ(second.without_action, (std::vector<std::int64_t>{0, 2}));
}

TEST(SilenceHandCases, TheFirstClassThatLacksAnActionIsNamed) {
  SortedJson spec = two_points({{"actions", {{"a", "x != 2"}, {"b", "x != 2"}}}});
  EXPECT_EQ(found(spec).without_action, (std::vector<std::int64_t>{2, 0}));
  // Outside K nothing is left to b, which has no rule; K' is larger than K.
  spec["controller"] = {{"synthesis", "given"}, {"allow", "x >= 1 or u >= 1"}};
  spec["silence"] = {{"actions", {{"a", "true"}}},
                     {"then", {{"a", "u == if(x >= 1, 0, 1)"}, {"b", "v == 0"}}}};
  EXPECT_EQ(found(spec).without_action, (std::vector<std::int64_t>{0, 10}));
}

TEST(SilenceHandCases, WhatIsForbiddenIsBlockedAlsoToOneAgentAlone) {
  SortedJson spec = two_points({{"actions", {{"a", "u == 1"}, {"b", "true"}}}});
  spec["controller"] = {{"allow", "u <= 0 or x != 1"}};
  EXPECT_EQ(found(spec).silence, (Silences{1, 0, 2, 1, 0}));
  spec["controller"] = {{"allow", "x != 1"}};  // of no input at all
  EXPECT_EQ(found(spec).silence, (Silences{0, -1, 2, 1, 0}));
}

TEST(SilenceHandCases, WhatComesAfterHasToBeSafeForEver) {
  const SortedJson actions = {{"a", "u == 1"}, {"b", "true"}};
  EXPECT_EQ(
      found(two_points({{"actions", actions}, {"then", {{"a", "u == if(x <= 2, 0, 1)"}, {"b", "v == 1"}}}}))
          .silence,
      (Silences{2, 1, 0, -1, -1}));
  // And to be something.
  EXPECT_EQ(found(two_points({{"actions", actions}, {"then", {{"a", "u == 0"}, {"b", "v == 1 and x <= 1"}}}}))
                .silence,
            (Silences{1, 0, -1, -1, -1}));
}

/// Cells where the task is over count as left for good: agents choose nothing there, and ways into them are
/// safe for ever.
TEST(SilenceHandCases, TheEndOfTheTaskIsReachedForGood) {
  SortedJson spec = two_points({{"actions", {{"a", "u == 1 and x != 3"}, {"b", "true"}}}});
  EXPECT_EQ(found(spec).silence, (Silences{3, 2, 1, 0, 0}));
  EXPECT_EQ(found(spec).without_action, (std::vector<std::int64_t>{2, 0}));
  spec["goal"] = {{"where", "x == 3"}, {"then", "over"}};
  EXPECT_EQ(found(spec).silence, (Silences{kForGood, kForGood, kForGood, kForGood, 0}));
  EXPECT_EQ(found(spec).without_action, (std::vector<std::int64_t>{0, 0}));
  spec["goal"]["where"] = "x == 1";
  EXPECT_EQ(found(spec).silence, (Silences{kForGood, kForGood, 1, 0, 0}));
  spec["goal"]["where"] = "x == 2 and y == 1";  // which b need not reach from y = 0
  EXPECT_EQ(found(spec).silence, (Silences{3, 2, 1, 0, 0}));
  spec["coordination"]["max_delay"] = 1;
  spec["goal"]["where"] = "x == 3";
  EXPECT_EQ(found(spec).silence, (Silences{1, 1, 1, 1, 0}));
}

TEST(SilenceHandCases, WhatComesAfterMayEndTheTask) {
  // Down from 2 on, where they fall out of the domain unless the task is over at 1; 3 and 4 rise out of it.
  const SortedJson then = {{"a", "u == if(x <= 2, -1, 1)"}, {"b", "v == 0 and x != 1"}};
  SortedJson spec = two_points({{"actions", {{"a", "u == 1"}, {"b", "true"}}}, {"then", then}});
  EXPECT_EQ(found(spec).silence, (Silences{-1, -1, -1, -1, -1}));
  spec["goal"] = {{"where", "x == 1"}, {"then", "over"}};
  EXPECT_EQ(found(spec).silence, (Silences{-1, kForGood, 0, -1, -1}));
  spec["goal"]["where"] = "x == 1 or x == 4";
  EXPECT_EQ(found(spec).silence, (Silences{-1, kForGood, kForGood, kForGood, kForGood}));
}

TEST(SilenceHandCases, OneAnswerServesAllPartitionsWhereAllHaveRules) {
  ThreadTeam team(1);
  SortedJson json = two_points({{"actions", {{"a", "u == 1"}, {"b", "true"}}}});
  json["coordination"]["partitions"] = "all";
  const FastAnalysis all(read_spec(json.dump(), "case"), team);
  EXPECT_EQ(all.answers->get<Silence>().partitions.size(), 1U);
  json["silence"]["actions"].erase("b");
  const FastAnalysis each(read_spec(json.dump(), "case"), team);
  EXPECT_EQ(each.answers->get<Silence>().partitions.size(), 2U);
}

}  // namespace
}  // namespace coordreq

// Systems small enough to compute by hand, of agents who see nothing: at each value of a state that stands
// still one action is right, and no agent can tell which.

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "answers/blind/answer.hpp"
#include "answers/step_codes.hpp"
#include "base/json.hpp"
#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"

namespace coordreq {
namespace {

using Steps = std::vector<std::int32_t>;

/// e becomes 1 at a mistake. @param s equation of the state that is the right action, 0 to `last`
SortedJson make_spec(int last, const char* s, const char* e, const SortedJson& values_of_second) {
  SortedJson spec = SortedJson::parse(R"({"coordreq": 1, "name": "case",
"states": [{"name": "s", "lower": 0, "step": 1, "discrete": true},
           {"name": "e", "lower": 0, "upper": 1, "step": 1, "discrete": true}],
"inputs": [{"name": "u1", "values": [0, 1]}, {"name": "u2"}],
"agents": [{"name": "one", "inputs": ["u1"], "sees": []}, {"name": "two", "inputs": ["u2"], "sees": []}],
"dynamics": {"time": "discrete", "period": 1}, "safe": "e == 0"})");
  spec["states"][0]["upper"] = last;
  spec["inputs"][1]["values"] = values_of_second;
  spec["dynamics"]["equations"] = {{"s", s}, {"e", e}};
  return spec;
}

SortedJson match() {
  return make_spec(1, "s", "if(u1 == s, 0, 1)", {0});
}
SortedJson toggle() {
  return make_spec(1, "1 - s", "if(u1 == s, 0, 1)", {0});
}
SortedJson order() {
  return make_spec(2, "s", "if(s == 0, if(u1 == 0, 0, 1), if(u1 == 1, if(u2 == s - 1, 0, 1), 1))", {0, 1});
}

struct Expected {
  std::vector<std::int64_t> layers;
  std::int32_t fixed_point_index;
  Steps delay;  ///< where e == 0, by s
};

Steps where_safe(const FastAnalysis& fast, const DelayLayers& layers) {
  Steps steps;
  for (std::int64_t x = 0; x < fast.safe.cells(); x += 2) {
    const std::int64_t level = layers.layers_of.at(x);
    steps.push_back(level == LevelMap::kTop ? layers.top_delay() : static_cast<std::int32_t>(level - 1));
  }
  return steps;
}

void expect_answer(const SortedJson& json, const Expected& expected) {
  ThreadTeam team(1);
  const ProblemSpec spec = read_spec(json.dump(), "case");
  const FastAnalysis fast(spec, team);
  const BlindPartition& blind = fast.answers->get<Blind>().partitions[0];
  EXPECT_EQ(blind.layers.sizes, expected.layers);
  EXPECT_EQ(blind.layers.fixed_point_index, expected.fixed_point_index);
  EXPECT_EQ(where_safe(fast, blind.delays), expected.delay);
  EXPECT_EQ(fast.layers[0].sizes,
            (std::vector<std::int64_t>{expected.layers.front()}));  // who sees needs nobody
}

TEST(BlindHandCases, OneActionHasToServeAllThatIsNotSeen) {
  expect_answer(match(), {{2, 1}, 1, {kUnbounded, 1}});
}

TEST(BlindHandCases, WhatIsRightOnceIsWrongTheNextTime) {
  expect_answer(toggle(), {{2, 1, 0}, 2, {1, 2}});
}

TEST(BlindHandCases, ClassesAreTakenInTheOrderOfTheSpec) {
  expect_answer(order(), {{3, 1}, 1, {1, kUnbounded, 1}});
  SortedJson exchanged = order();
  std::swap(exchanged["agents"][0], exchanged["agents"][1]);
  expect_answer(exchanged, {{3, 1}, 1, {kUnbounded, 1, 1}});
}

TEST(BlindHandCases, SightIsOfUse) {
  SortedJson spec = order();
  spec["agents"][0]["sees"] = {"s"};
  expect_answer(spec, {{3, 2}, 1, {kUnbounded, kUnbounded, 1}});
}

TEST(BlindHandCases, TablesHoldWhatIsRightWhereverTheSystemMayBe) {
  ThreadTeam team(1);
  const ProblemSpec spec = read_spec(toggle().dump(), "case");
  const FastAnalysis fast(spec, team);
  const BlindPartition& blind = fast.answers->get<Blind>().partitions[0];
  EXPECT_EQ(blind.table_steps(), 2);
  const SilentTable& one = blind.tables[0];
  ASSERT_EQ(one.fibres(), 1);
  // B_1 is s = 0, of equals the lower action; B_2 is empty, so that nothing is said.
  EXPECT_TRUE(one.allows(0, 0, 1));
  EXPECT_FALSE(one.allows(0, 1, 1));
  EXPECT_FALSE(one.allows(0, 0, 2));
  EXPECT_FALSE(one.allows(0, 1, 2));
}

TEST(BlindHandCases, AMemoryIsSeenByWhoSeesWhatItRemembers) {
  ThreadTeam team(1);
  // Once it is known that s was 1 it is known for ever, by who sees s.
  SortedJson json = match();
  json["memory"] = {{"was", "previous(s >= 1)"}};
  for (const bool sees : {false, true}) {
    if (sees) json["agents"][0]["sees"] = {"s"};
    const ProblemSpec spec = read_spec(json.dump(), "case");
    const FastAnalysis fast(spec, team);
    const BlindPartition& blind = fast.answers->get<Blind>().partitions[0];
    EXPECT_EQ(blind.tables[0].fibres(), sees ? 4 : 1);
    EXPECT_EQ(blind.tables[1].fibres(), 1);
  }
}

TEST(BlindHandCases, WithNoStepNothingIsTold) {
  ThreadTeam team(1);
  SortedJson json = match();
  json["coordination"]["max_delay"] = 0;
  const ProblemSpec spec = read_spec(json.dump(), "case");
  const FastAnalysis fast(spec, team);
  const BlindPartition& blind = fast.answers->get<Blind>().partitions[0];
  EXPECT_TRUE(blind.layers.truncated);
  EXPECT_EQ(where_safe(fast, blind.delays), (Steps{0, 0}));
  EXPECT_EQ(blind.table_steps(), 1);
  EXPECT_FALSE(blind.tables[0].allows(0, 0, 1));
}

}  // namespace
}  // namespace coordreq

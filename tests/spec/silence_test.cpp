#include "spec/silence.hpp"

#include <gtest/gtest.h>

#include <string>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

nlohmann::json spec_with(const nlohmann::json& silence) {
  nlohmann::json spec = test::example();
  spec["silence"] = silence;
  return spec;
}

TEST(SilenceSpec, HasConditionsByAgent) {
  const ProblemSpec spec = test::read(spec_with({{"actions", {{"b", "u2 <= x1"}}}}));
  ASSERT_TRUE(spec.silence.has_value());
  EXPECT_FALSE(spec.silence->actions[0].has_value());
  EXPECT_EQ(spec.silence->actions[1]->text, "u2 <= x1");
  EXPECT_FALSE(spec.silence->has_then());
  EXPECT_FALSE(all_have_rules(*spec.silence));
  const ProblemSpec both = test::read(spec_with(
      {{"actions", {{"a", "true"}, {"b", "true"}}}, {"then", {{"b", "u2 == 0"}, {"a", "u1 == 0"}}}}));
  EXPECT_TRUE(all_have_rules(*both.silence));
  ASSERT_TRUE(both.silence->has_then());
  EXPECT_EQ(both.silence->then[0]->text, "u1 == 0");
  EXPECT_FALSE(test::read(test::example()).silence.has_value());
}

TEST(SilenceSpec, IsAboutAgentsAndAllOfThemAfterwards) {
  EXPECT_EQ(test::error_of(spec_with(nlohmann::json::object())),
            "missing key: one of 'actions', 'then' or 'hold' (/silence)");
  EXPECT_EQ(test::error_of(spec_with({{"actions", {{"c", "true"}}}})),
            "'c' is not an agent (/silence/actions)");
  EXPECT_EQ(test::error_of(spec_with({{"then", {{"a", "u1 == 0"}}}})),
            "expected a condition for each agent, found none for 'b' (/silence/then)");
  EXPECT_EQ(test::error_of(spec_with({{"actions", {{"a", "u1"}}}})).find("expected a condition"), 0U);
}

TEST(SilenceSpec, ReadsOwnInputsAndStatesThatAreSeen) {
  EXPECT_EQ(
      test::error_of(spec_with({{"actions", {{"a", "u2 <= 0"}}}})),
      "expected inputs of the agent 'a' and states that it sees, found the input 'u2' (/silence/actions/a)");
  nlohmann::json spec = spec_with({{"actions", {{"a", "u1 <= x2"}}}});
  EXPECT_EQ(test::error_of(spec), "");
  spec["agents"][0]["sees"] = {"x1"};
  EXPECT_EQ(
      test::error_of(spec),
      "expected inputs of the agent 'a' and states that it sees, found the state 'x2' (/silence/actions/a)");
  spec["definitions"]["behind"] = "x2 + 1";
  spec["silence"]["actions"]["a"] = "u1 <= behind";
  EXPECT_EQ(
      test::error_of(spec),
      "expected inputs of the agent 'a' and states that it sees, found the state 'x2' (/silence/actions/a)");
}

TEST(SilenceSpec, MemoriesCountAsWhatTheirFormulasRead) {
  nlohmann::json spec = spec_with({{"actions", {{"a", "late or u1 == 0"}}}});
  spec["memory"] = {{"late", "previous(x2 >= 0)"}};
  EXPECT_EQ(test::error_of(spec), "");
  spec["agents"][0]["sees"] = {"x1"};
  EXPECT_EQ(
      test::error_of(spec),
      "expected inputs of the agent 'a' and states that it sees, found the memory 'late', whose formula "
      "reads more (/silence/actions/a)");
  spec["agents"][0]["sees"] = {"x2"};
  EXPECT_EQ(test::error_of(spec), "");
}

TEST(SilenceSpec, WhatIsMeasuredWithAnErrorIsForOneAgent) {
  nlohmann::json spec = spec_with(
      {{"actions", {{"a", "u1 <= x1"}}}, {"then", {{"a", "x1 > 0 or u1 == 0"}, {"b", "u2 <= x2"}}}});
  spec["states"][0]["measurement_error"] = 0.25;
  EXPECT_EQ(test::error_of(spec), "");
  spec["silence"]["then"]["b"] = "u2 <= x1";
  EXPECT_EQ(
      test::error_of(spec),
      "expected a state with a measurement error in conditions of one agent, found 'x1' in those of 'a' and "
      "'b' (/silence/then/b)");
}

}  // namespace
}  // namespace coordreq

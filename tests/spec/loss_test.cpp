// Networks with numbers, and the risk that is asked of them.

#include <gtest/gtest.h>

#include <string>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Transitions = std::vector<std::pair<std::int32_t, std::int32_t>>;

NetworkSpec network(const std::string& text) {
  return test::read(test::example_with("/network", text)).network.value();
}

/// "0.9 0.1", "0.9..1 0..0.1"
std::string probabilities(const NetworkSpec& network) {
  std::string text;
  for (const ProbabilityRange& range : network.probabilities) {
    text += (text.empty() ? "" : " ") + to_text(range.low);
    if (range.low != range.high) text += ".." + to_text(range.high);
  }
  return text;
}

TEST(Loss, IsOneOfTwoModes) {
  const NetworkSpec plain = network(R"({"loss": 0.1})");
  EXPECT_EQ(plain.kind, NetworkKind::loss);
  ASSERT_EQ(plain.modes.size(), 2U);
  EXPECT_EQ(plain.modes[0].name, "up");
  EXPECT_EQ(plain.modes[0].partition.canonical, "a+b");
  EXPECT_EQ(plain.modes[1].name, "down");
  EXPECT_EQ(plain.modes[1].partition.canonical, "a|b");
  EXPECT_EQ(plain.transitions, (Transitions{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
  EXPECT_EQ(probabilities(plain), "0.9 0.1 0.9 0.1");
}

TEST(Loss, DependsOnTheStepBefore) {
  EXPECT_EQ(probabilities(network(R"({"loss": "1/3", "after_loss": [0.5, 0.75]})")),
            "2/3 1/3 0.25..0.5 0.5..0.75");
}

TEST(Loss, WhatCannotHappenIsNoTransition) {
  const NetworkSpec never = network(R"({"loss": 0, "after_loss": 1})");
  EXPECT_EQ(never.transitions, (Transitions{{0, 0}, {1, 1}}));
  EXPECT_EQ(probabilities(never), "1 1");
}

TEST(Loss, RangesAreNarrowedToWhatSumsToOne) {
  const NetworkSpec narrowed =
      network(R"({"modes": [{"name": "m", "partition": "a+b"}, {"name": "n", "partition": "a|b"}],
"transitions": [["m", "m", [0.25, 0.5]], ["m", "n", [0, 1]], ["n", "m", 1], ["n", "n", [0, 0.5]]]})");
  EXPECT_EQ(probabilities(narrowed), "0.25..0.5 0.5..0.75 1");
  EXPECT_EQ(narrowed.transitions, (Transitions{{0, 0}, {0, 1}, {1, 0}}));
}

TEST(Loss, SumsAreExact) {
  EXPECT_EQ(probabilities(
                network(R"({"modes": [{"name": "m", "partition": "a+b"}, {"name": "n", "partition": "a|b"},
{"name": "o", "partition": "a|b"}], "transitions": [["m", "m", 0.1], ["m", "n", 0.2], ["m", "o", 0.7],
["n", "m", 1], ["o", "m", 1]]})")),
            "0.1 0.2 0.7 1 1");
}

std::string refused(const std::string& pointer, const std::string& text) {
  return test::error_of(test::example_with(pointer, text));
}

TEST(Loss, RefusesWhatIsNoProbability) {
  EXPECT_EQ(refused("/network", R"({"loss": 1.5})"),
            "expected a probability from 0 to 1, found 1.5 (/network/loss)");
  EXPECT_EQ(refused("/network", R"({"loss": [-0.5, 0.5]})"),
            "expected a probability from 0 to 1, found -0.5 (/network/loss/0)");
  EXPECT_EQ(refused("/network", R"({"loss": [0.2, 0.1]})"),
            "expected the least probability before the greatest, found [0.2, 0.1] (/network/loss)");
  EXPECT_EQ(refused("/network", R"({"loss": [0.2]})"),
            "expected a list of the least and the greatest probability, found a list of 1 (/network/loss)");
  EXPECT_EQ(refused("/network", R"({"loss": true})"),
            "expected a probability or a list of the least and the greatest one, found true (/network/loss)");
  EXPECT_EQ(refused("/network", R"({"delay": 1, "after_loss": 0.5})"),
            "'after_loss' needs 'loss' (/network)");
}

std::string two_modes(const std::string& transitions) {
  return R"({"modes": [{"name": "m", "partition": "a+b"}, {"name": "n", "partition": "a|b"}],
"transitions": )" +
         transitions + "}";
}

TEST(Loss, RefusesSumsThatCannotBeOne) {
  EXPECT_EQ(refused("/network", two_modes(R"([["m", "m", 0.5], ["m", "n", 0.6], ["n", "m", 1]])")),
            "expected probabilities of what follows the mode 'm' that can be 1 in sum, found at least 1.1 "
            "(/network/transitions)");
  EXPECT_EQ(refused("/network", two_modes(R"([["m", "m", 1], ["n", "m", [0, 0.9]]])")),
            "expected probabilities of what follows the mode 'n' that can be 1 in sum, found at most 0.9 "
            "(/network/transitions)");
}

TEST(Loss, AllTransitionsHaveNumbersOrNone) {
  EXPECT_EQ(refused("/network", two_modes(R"([["m", "m", 1], ["n", "m"]])")),
            "expected a probability in all transitions or in none, found 1 of 2 with one "
            "(/network/transitions)");
}

RiskSpec risk(const std::string& text) {
  auto spec = test::example_with("/network", R"({"loss": 0.1})");
  spec["risk"] = nlohmann::json::parse(text);
  return test::read(spec).risk.value();
}

std::string refused_risk(const std::string& text, const std::string& network = R"({"loss": 0.1})") {
  auto spec = test::example_with("/network", network);
  spec["risk"] = nlohmann::json::parse(text);
  return test::error_of(spec);
}

TEST(RiskSpec, HasAHorizonInStepsOrTime) {
  EXPECT_EQ(risk(R"({"horizon": 7})").horizon, 7);
  EXPECT_FALSE(risk(R"({"horizon": 7})").is_safest);
  EXPECT_FALSE(risk(R"({"horizon": 7, "coordinated": "any"})").is_safest);
  EXPECT_TRUE(risk(R"({"horizon": 7, "coordinated": "safest"})").is_safest);
  EXPECT_EQ(risk(R"({"horizon_time": 2.5})").horizon, 3) << "the period is 1";
}

TEST(RiskSpec, RefusesWhatHasNoMeaning) {
  EXPECT_EQ(refused_risk(R"({"horizon": 0})"),
            "expected an integer from 1 to 2147483646, found 0 (/risk/horizon)");
  EXPECT_EQ(refused_risk(R"({"horizon_time": 0})"), "expected a time > 0, found 0 (/risk/horizon_time)");
  EXPECT_EQ(refused_risk(R"({"coordinated": "any"})"),
            "missing key: one of 'horizon' or 'horizon_time' (/risk)");
  EXPECT_EQ(refused_risk(R"({"horizon": 1, "coordinated": "best"})"),
            "expected 'any' or 'safest', found 'best' (/risk/coordinated)");
  const std::string numbers =
      "'risk' is for a network with probabilities, expected 'loss' or transitions with numbers (/risk)";
  EXPECT_EQ(refused_risk(R"({"horizon": 1})", R"({"delay": 1})"), numbers);
  EXPECT_EQ(refused_risk(R"({"horizon": 1})", two_modes(R"([["m", "m"], ["n", "m"]])")), numbers);
}

TEST(RiskSpec, NobodyIsSafestWithTheControllerAsItIsGiven) {
  auto spec = test::example_with("/network", R"({"loss": 0.1})");
  spec["controller"]["synthesis"] = "given";
  spec["risk"] = {{"horizon", 1}, {"coordinated", "safest"}};
  EXPECT_EQ(test::error_of(spec),
            "'safest' is for agents who choose, expected 'any' with the controller as it is 'given' "
            "(/risk/coordinated)");
}

}  // namespace
}  // namespace coordreq

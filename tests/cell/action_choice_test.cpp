#include "cell/action_choice.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "loop_fixture.hpp"

namespace coordreq {
namespace {

using test::line_spec;
using test::LoopFixture;

const std::vector<std::int32_t> kDelays = {8, 7, 6, 5, 4, 3, 2, 1, 0, -2};

std::string ladder(const std::string& prefer_of_a = "", const std::string& prefer_of_b = "") {
  const auto agent = [](const std::string& head, const std::string& prefer) {
    return head + (prefer.empty() ? "}" : R"(, "prefer": ")" + prefer + "\"}");
  };
  return line_spec(10, "x + u + v", R"({"below": "saturate"})",
                   agent(R"({"name": "a", "inputs": ["u"])", prefer_of_a) + "," +
                       agent(R"({"name": "b", "inputs": ["v"])", prefer_of_b));
}

std::optional<std::int64_t> chosen(const LoopFixture& loop, Policy policy, const Rational& x,
                                   bool coordinated, std::uint64_t seed = 1) {
  PointDynamics dynamics(loop.spec());
  KeptInputs controller;
  ActionChooser chooser(loop.problem(), policy, dynamics, controller);
  NextStates next(loop.spec(), loop.abstraction(), dynamics);
  const std::vector<Rational> state{x};
  const std::vector<Rational> error{Rational(0)};
  next.begin(state, {}, error, floor_to_int(x + Rational(1) / 2));
  RandomStream random(seed, 0, RandomStream::Purpose::actions);
  return chooser.choose(floor_to_int(x + Rational(1) / 2), state, {.countdown = coordinated ? 0 : 1}, next,
                        random);
}

TEST(ActionChooser, RandomIsUniformInTheControllerWhenCoordinated) {
  const LoopFixture loop(ladder(), kDelays);
  std::map<std::int64_t, int> counts;
  for (std::uint64_t seed = 0; seed < 900; ++seed) {
    ++counts[*chosen(loop, Policy::random, 8, true, seed)];
  }
  EXPECT_EQ(counts.size(), 3U);  // all but (1, 0)
  for (const auto& [u, count] : counts) EXPECT_NEAR(count, 300, 90) << u;
}

TEST(ActionChooser, RandomIsUniformInEachProjectionWhenAlone) {
  const LoopFixture loop(ladder(), kDelays);
  std::map<std::int64_t, int> counts;
  for (std::uint64_t seed = 0; seed < 800; ++seed) {
    ++counts[*chosen(loop, Policy::random, 8, false, seed)];
  }
  EXPECT_EQ(counts.size(), 4U);  // (1, 0) too: that is why cell 8 has delay 0
  for (const auto& [u, count] : counts) EXPECT_NEAR(count, 200, 75) << u;
}

TEST(ActionChooser, AdversarialTakesTheSmallestDelay) {
  const LoopFixture loop(ladder(), kDelays);
  EXPECT_EQ(chosen(loop, Policy::adversarial, 5, false), 3);
  EXPECT_EQ(chosen(loop, Policy::adversarial, 8, false), 3);  // out of K, if asked there
}

TEST(ActionChooser, AdversarialIsBoundToTheControllerWhenCoordinated) {
  const LoopFixture loop(ladder(), kDelays);
  // (0, 0) and (1, -1) both stay in cell 8, with the same margin: the smaller number.
  EXPECT_EQ(chosen(loop, Policy::adversarial, 8, true), 1);
}

TEST(ActionChooser, AdversarialBreaksTiesByTheMargin) {
  EXPECT_EQ(chosen(LoopFixture(ladder(), std::vector<std::int32_t>(10, 3)), Policy::adversarial, 5, false),
            3);
}

TEST(ActionChooser, AgentsAlonePreferWithTheOthersAtRest) {
  // Each thinks that the other stays: from 5 a sees 6 rather than 5; b sees 4 and 5, which are alike to it.
  const LoopFixture loop(ladder("abs(x - 6.5)", "abs(x - 4.5)"), kDelays);
  EXPECT_EQ(chosen(loop, Policy::prefer, 5, false), 2);
  EXPECT_EQ(chosen(loop, Policy::prefer, Rational(19) / 4, false), 3);  // 4.75 is nearer than 3.75
}

TEST(ActionChooser, CoordinatingAgentsMinimiseTheSum) {
  // (x - 6)^2 + 3 (x - 4)^2 is smallest at 4.5; from 5: 4 gives 4, 5 gives 4, 6 gives 12.
  const LoopFixture loop(ladder("(x - 6)^2", "3*(x - 4)^2"), kDelays);
  EXPECT_EQ(chosen(loop, Policy::prefer, 5, true), 0);
  EXPECT_EQ(chosen(loop, Policy::prefer, Rational(9) / 2, true), 1);
}

TEST(ActionChooser, PreferencesSeeTheInputsToo) {
  const LoopFixture loop(ladder("(u - 1)^2", "v"), kDelays);
  EXPECT_EQ(chosen(loop, Policy::prefer, 5, false), 2);
}

TEST(ActionChooser, AnUndefinedPreferenceIsTheWorst) {
  const LoopFixture loop(ladder("sqrt(5.5 - x)", "0"), kDelays);
  // From 5 upwards is undefined, from 4 it is better.
  EXPECT_EQ(*chosen(loop, Policy::prefer, 5, false) / 2, 0);
  EXPECT_EQ(*chosen(loop, Policy::prefer, 4, false) / 2, 1);
}

TEST(ActionChooser, WithoutAnActionThereIsNoChoice) {
  const LoopFixture lost(line_spec(10, "x + 1"), {-1, -1, -1, -1, -1, 3, -1, -1, -1, -1});
  EXPECT_EQ(chosen(lost, Policy::random, 5, true), std::nullopt);
}

/// From 3 a step of 6 ends in K, across an obstacle.
TEST(ActionChooser, NobodyGoesThroughWhatIsUnsafeOnTheWay) {
  const LoopFixture loop(R"json({"coordreq": 1, "name": "jump",
    "states": [{"name": "x", "lower": 0, "upper": 12, "step": 1}],
    "inputs": [{"name": "u", "values": [0, 6]}], "agents": [{"name": "a", "inputs": ["u"]}],
    "dynamics": {"time": "continuous", "period": 1, "equations": {"x": "u"}},
    "safe": "abs(x - 6) >= 1.5", "abstraction": {"between_samples": true}})json",
                         {kUnbounded, kUnbounded, kUnbounded, kUnbounded, kUnbounded, -2, -2, -2, kUnbounded,
                          kUnbounded, kUnbounded, kUnbounded, kUnbounded});
  for (const bool coordinated : {false, true}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed)
      EXPECT_EQ(chosen(loop, Policy::random, 3, coordinated, seed), 0);
  }
}

TEST(AdmissibleInputs, AreThoseOfTheDefinition) {
  const LoopFixture loop(ladder(), kDelays);
  MembersByCell invariant(loop.abstraction().grid, [](std::int64_t cell) { return cell <= 8; });
  CellPosts posts(loop.abstraction());
  AdmissibleInputs inputs(loop.spec(), posts, {.invariant = &invariant});
  EXPECT_EQ(inputs.of(8), (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(inputs.of(0), (std::vector<std::int64_t>{0, 1, 2, 3}));
}

TEST(AdmissibleInputs, ObeyAllow) {
  const LoopFixture loop(line_spec(10, "x + u", "\"saturate\"", R"({"name": "a", "inputs": ["u"]},
                                                                   {"name": "b", "inputs": ["v"]})",
                                   R"(, "controller": {"allow": "x >= 3 and u + v == 0"})"),
                         kDelays);
  MembersByCell everything(loop.abstraction().grid, [](std::int64_t) { return true; });
  CellPosts posts(loop.abstraction());
  AdmissibleInputs inputs(loop.spec(), posts, {.invariant = &everything});
  EXPECT_EQ(inputs.of(5), (std::vector<std::int64_t>{1, 2}));
  EXPECT_TRUE(inputs.of(2).empty());
}

}  // namespace
}  // namespace coordreq

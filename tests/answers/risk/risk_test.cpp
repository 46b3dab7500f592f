// How much slack is there to a brink? Two agents press 0, 1 or 2: both 2 gives slack back (up to 3), both the
// same leaves it, different buttons cost one, and without slack that is over the brink, out of the domain.
//
// K is everything, and C all in slack > 0, in 0 what is the same. Connected agents of whom nothing is known
// but C ("any") may waste their slack too; alone they may always choose differently. So the worst case of a
// step costs one slack, connected or not, but at the brink: there connected agents stay.
//
// With loss 1/10: from 0, connected, each of the next N steps but the last is followed by a lost one with
// 1/10, and a lost step at the brink is over it: 1 - (9/10)^(N-1) = 3439/10000 for N = 5. From 1 it takes a
// step to get to the brink, and then N - 1 steps remain, of which the last is before its own loss counts...
// the figures of the other slacks follow likewise, by hand.

#include "answers/risk/risk.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "answers/risk/answer.hpp"
#include "answers/risk/risk_levels.hpp"
#include "base/json.hpp"
#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"

namespace coordreq {
namespace {

Json brink() {
  return Json::parse(R"json({"coordreq": 1, "name": "brink", "states": [
{"name": "d", "lower": 0, "upper": 3, "step": 1, "discrete": true,
 "outside": {"below": "unsafe", "above": "saturate"}}],
"inputs": [{"name": "u1", "values": [0, 1, 2]}, {"name": "u2", "values": [0, 1, 2]}],
"agents": [{"name": "one", "inputs": ["u1"]}, {"name": "two", "inputs": ["u2"]}],
"dynamics": {"time": "discrete", "period": 1,
             "equations": {"d": "if(u1 == u2, if(u1 == 2, d + 1, d), d - 1)"}},
"safe": "true", "network": {"loss": 0.1}, "risk": {"horizon": 5}})json");
}

struct FoundRisk {
  std::vector<std::vector<double>> risk;  ///< [mode][slack]
  double rate;
  std::vector<RiskFigures> figures;
};

FoundRisk find_brink(const Json& spec) {
  ThreadTeam team(2);
  const FastAnalysis fast(read_spec(spec.dump(), "brink"), team);
  const RiskAnswer& answer = fast.answers->get<RiskAnswer>();
  FoundRisk found{.risk = {}, .rate = answer.risk.rate, .figures = answer.figures};
  for (const RiskRows& rows : answer.risk.risks) {
    auto& risks = found.risk.emplace_back();
    for (std::int64_t x = 0; x < 4; ++x)
      risks.push_back(double{risk_of(rows.row(x / rows.row_length())[x % rows.row_length()])});
  }
  return found;
}

/// Not below the exact ones, and no more than some roundings above them.
void expect_risks(const std::vector<double>& found, const std::vector<Rational>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t x = 0; x < found.size(); ++x) {
    EXPECT_GE(exact(found[x]), expected[x]) << x;
    EXPECT_LE(exact(found[x]), expected[x] * Rational(1000001, 1000000)) << x;
  }
}

void expect_rate(double found, const Rational& expected) {
  EXPECT_NEAR(found, nearest_double(expected), 1e-6);
}

Rational fraction(long numerator, long denominator) {
  Rational result(numerator, denominator);
  result.canonicalize();
  return result;
}

TEST(RiskOfABrink, SlackIsWastedWhileAgentsAreConnected) {
  const FoundRisk found = find_brink(brink());
  expect_risks(found.risk[0],
               {fraction(3439, 10000), fraction(3439, 10000), fraction(271, 1000), fraction(19, 100)});
  expect_rate(found.rate, fraction(81, 1000));
}

TEST(RiskOfABrink, OneStepLess) {
  Json spec = brink();
  spec["risk"]["horizon"] = 4;
  const FoundRisk found = find_brink(spec);
  expect_risks(found.risk[0], {fraction(271, 1000), fraction(271, 1000), fraction(19, 100), fraction(1, 10)});
  expect_risks(found.risk[1], {1, fraction(271, 1000), fraction(19, 100), fraction(1, 10)});
}

TEST(RiskOfABrink, WhatIsForbiddenBlocksTheProduct) {
  Json spec = brink();
  spec["controller"]["allow"] = "u1 == u2";
  const FoundRisk found = find_brink(spec);
  const Rational up = fraction(3439, 10000);
  expect_risks(found.risk[0], {up, up, up, up});
  expect_risks(found.risk[1], {1, 1, 1, 1});
}

/// All posts have left for good, so that no row is ever met: but forbidden joint inputs count at once.
TEST(RiskOfABrink, WhatIsForbiddenCountsWhereAllHaveLeftTheDomain) {
  Json spec = brink();
  spec["states"][0]["outside"]["above"] = "safe";
  spec["dynamics"]["equations"]["d"] = "d + 4";
  spec["controller"]["allow"] = "u1 == u2";
  const FoundRisk found = find_brink(spec);
  EXPECT_EQ(found.risk, (std::vector<std::vector<double>>{{0, 0, 0, 0}, {1, 1, 1, 1}}));
}

TEST(RiskOfABrink, TheSafestGiveSlackBack) {
  Json spec = brink();
  spec["risk"]["coordinated"] = "safest";
  const FoundRisk found = find_brink(spec);
  expect_risks(found.risk[0],
               {fraction(59, 5000), fraction(1, 1000), fraction(1, 10000), fraction(1, 10000)});
  expect_rate(found.rate, fraction(81, 50000));
}

TEST(RiskOfABrink, BurstsCostMore) {
  Json spec = brink();
  spec["network"]["after_loss"] = 0.5;
  spec["risk"]["coordinated"] = "safest";
  const FoundRisk found = find_brink(spec);
  expect_risks(found.risk[0], {fraction(3, 40), fraction(1, 40), fraction(1, 80), fraction(1, 80)});
  expect_rate(found.rate, fraction(3, 160));
}

TEST(RiskOfABrink, TheWorstOfARangeIsItsUpperEnd) {
  Json spec = brink();
  const FoundRisk sure = find_brink(spec);
  spec["network"]["loss"] = {0, 0.1};
  const FoundRisk range = find_brink(spec);
  for (std::size_t mode = 0; mode < 2; ++mode) {
    for (std::size_t x = 0; x < 4; ++x) EXPECT_NEAR(range.risk[mode][x], sure.risk[mode][x], 1e-7);
  }
  expect_rate(range.rate, fraction(81, 1000));
}

TEST(RiskOfABrink, WithoutLossesThereIsNoRisk) {
  Json spec = brink();
  spec["network"]["loss"] = 0;
  const FoundRisk found = find_brink(spec);
  EXPECT_EQ(found.risk[0], (std::vector<double>(4, 0)));
  EXPECT_EQ(found.rate, 0);
}

TEST(RiskOfABrink, FiguresCountTheCellsOfK) {
  Json spec = brink();
  spec["risk"]["coordinated"] = "safest";
  const std::vector<RiskFigures> figures = find_brink(spec).figures;
  EXPECT_NEAR(*figures[0].worst, 59.0 / 5000, 1e-8);
  EXPECT_NEAR(*figures[0].mean, (59.0 / 5000 + 1e-3 + 2e-4) / 4, 1e-9);
  // At most 1e-4 is none, as it is rounded up; at most 1e-3 two, 1e-2 three, 1e-1 four.
  EXPECT_EQ(figures[0].within, (std::array<std::int64_t, 13>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 3, 4}));
  spec["safe"] = "false";
  const RiskFigures none = find_brink(spec).figures[0];
  EXPECT_FALSE(none.worst.has_value());
  EXPECT_FALSE(none.mean.has_value());
}

}  // namespace
}  // namespace coordreq

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using test::error_of_text;

/// The example with a raw text for the period, which JSON libraries would round.
std::string text_with_period(const std::string& typed) {
  std::string text = test::example_with("/dynamics/period", "\"HERE\"").dump();
  return text.replace(text.find("\"HERE\""), 6, typed);
}

Rational period(const std::string& typed) {
  return read_spec(text_with_period(typed), "test.json").dynamics.period;
}

TEST(Number, IsTheDecimalThatWasTyped) {
  EXPECT_EQ(period("0.1"), Rational(1, 10));
  EXPECT_EQ(period("1e-3"), Rational(1, 1000));
  EXPECT_EQ(period("12.50E+2"), 1250);
  EXPECT_EQ(period("3"), 3);
  EXPECT_EQ(period("9223372036854775807"), Rational("9223372036854775807"));
  EXPECT_EQ(period("18446744073709551615"), Rational("18446744073709551615"));
  EXPECT_EQ(period("123456789012345678901234567890"), Rational("123456789012345678901234567890"));
  EXPECT_EQ(period("0.1000000000000000055511151231257827"),
            Rational("1000000000000000055511151231257827/10000000000000000000000000000000000"));
}

TEST(Number, BelowTheRangeOfADoubleIsExactToo) {
  const Rational tiny = period("1e-400");
  EXPECT_GT(tiny, 0);
  EXPECT_EQ(tiny * period("1e200") * period("1e200"), 1);
}

TEST(Number, BeyondTheRangeOfADoubleIsRefused) {
  EXPECT_EQ(error_of_text(text_with_period("\"10^309\"")),
            "'10^309' is too large for a double (/dynamics/period)");
  EXPECT_EQ(error_of_text(text_with_period("1e-6000")),
            "number with an exponent beyond 5000: '1e-6000' (/dynamics/period)");
}

TEST(Number, ConstantExpressionIsExactOnRationals) {
  EXPECT_EQ(period("\"1/3\""), Rational(1, 3));
  EXPECT_EQ(period("\"R/4\""), Rational(1, 5));
  EXPECT_EQ(period("\"0.1 + 0.2\""), Rational(3, 10));
  EXPECT_EQ(period("\"2*pi\""), 2 * exact(3.14159265358979323846));
  EXPECT_EQ(period("\"sqrt(2)\""), exact(1.4142135623730951));
}

TEST(Number, ConstantsReferToEachOtherInAnyOrder) {
  const auto spec = test::example_with("/constants", R"({"R": "b + 1", "b": "c/2", "c": 0.1})");
  const ProblemSpec read = test::read(spec);
  EXPECT_EQ(read.safe.text, "r2 <= R^2");
  const auto with_period = test::example_with("/constants", R"({"R": 1, "b": "c/2", "c": 0.1, "a": "b^2"})");
  auto changed = with_period;
  changed["dynamics"]["period"] = "a";
  EXPECT_EQ(test::read(changed).dynamics.period, Rational(1, 400));
}

TEST(Number, TowersOfPowersAreRefused) {
  auto spec = test::example();
  spec["constants"]["c0"] = "1/3";
  for (int i = 1; i < 20; ++i) {
    spec["constants"]["c" + std::to_string(i)] = "c" + std::to_string(i - 1) + "^1000";
  }
  EXPECT_NE(test::error_of(spec), "");
}

TEST(Number, GridByStepHasExactlyThePointsInside) {
  auto spec = test::example();
  spec["states"][0] = {{"name", "x1"}, {"lower", -1}, {"upper", 1}, {"step", 0.1}};
  spec["states"][1] = {{"name", "x2"}, {"lower", 0.25}, {"upper", 2.2}, {"step", 0.5}, {"origin", 0.1}};
  const ProblemSpec read = test::read(spec);
  EXPECT_EQ(read.states[0].grid.first, -1);
  EXPECT_EQ(read.states[0].grid.step, Rational(1, 10));
  EXPECT_EQ(read.states[0].grid.count, 21);
  EXPECT_EQ(read.states[1].grid.first, Rational(3, 5));
  EXPECT_EQ(read.states[1].grid.count, 4);
  EXPECT_EQ(read.states[1].lower, Rational(1, 4));
}

TEST(Number, GridByCountTakesBothEndsUnlessPeriodic) {
  auto spec = test::example();
  spec["states"][0] = {{"name", "x1"}, {"lower", -1}, {"upper", 1}, {"count", 4}};
  spec["states"][1] = {
      {"name", "x2"}, {"lower", "-pi"}, {"upper", "pi"}, {"count", 72}, {"outside", "periodic"}};
  const ProblemSpec read = test::read(spec);
  EXPECT_EQ(read.states[0].grid.first, -1);
  EXPECT_EQ(read.states[0].grid.step, Rational(2, 3));
  EXPECT_EQ(read.states[0].grid.count, 4);
  const Rational pi = exact(3.14159265358979323846);
  EXPECT_EQ(read.states[1].grid.first, -pi);
  EXPECT_EQ(read.states[1].grid.step, 2 * pi / 72);
  EXPECT_EQ(read.states[1].grid.count, 72);
  EXPECT_EQ(read.states[1].upper, pi);
  spec["states"][1]["count"] = 1;
  EXPECT_EQ(test::read(spec).states[1].grid.count, 1);
}

TEST(Number, TimesBecomeStepsByExactCeiling) {
  auto spec = test::example();
  spec["dynamics"]["period"] = 0.1;
  const auto steps = [&](const nlohmann::json& time) {
    spec["coordination"]["horizon_time"] = time;
    return test::read(spec).coordination.horizon.value();
  };
  EXPECT_EQ(steps(0.3), 3);  // 0.3 / 0.1 is above 3 in doubles
  EXPECT_EQ(steps("0.3 + 1e-30"), 4);
  EXPECT_EQ(steps(0), 0);
}

TEST(Number, LongChainsOfDefinitionsAreLinked) {
  auto spec = test::example();
  constexpr int kLength = 10'000;
  spec["definitions"]["d0"] = "x1";
  for (int i = 1; i < kLength; ++i) {
    spec["definitions"]["d" + std::to_string(i)] = "d" + std::to_string(i - 1) + " + 1";
  }
  spec["safe"] = "d" + std::to_string(kLength - 1) + " < 0";
  EXPECT_EQ(test::read(spec).safe.variables(), std::vector<std::uint32_t>{0});
}

TEST(Number, DefinitionsAreInlinedWhateverTheirType) {
  auto spec = test::example();
  spec["definitions"] = {
      {"near", "r2 < lim and not far"}, {"far", "x1 > 9"}, {"r2", "x1^2 + x2^2"}, {"lim", "R*2"}};
  spec["safe"] = "near or far or r2 == r2";
  auto plain = test::example();
  plain["safe"] = "((x1^2 + x2^2 < 0.8*2 and not (x1 > 9)) or x1 > 9) or x1^2 + x2^2 == x1^2 + x2^2";
  const Program inlined = test::read(spec).safe;
  const Program written = test::read(plain).safe;
  ASSERT_EQ(inlined.nodes.size(), written.nodes.size());
  std::vector<Operator> operators_inlined, operators_written;
  for (const auto& node : inlined.nodes) operators_inlined.push_back(node.op);
  for (const auto& node : written.nodes) operators_written.push_back(node.op);
  std::sort(operators_inlined.begin(), operators_inlined.end());
  std::sort(operators_written.begin(), operators_written.end());
  EXPECT_EQ(operators_inlined, operators_written);
  EXPECT_EQ(inlined.text, "near or far or r2 == r2");
  EXPECT_EQ(test::error_of(test::example_with("/definitions/a", "\"1 + (x1 < 2)\"")),
            "expected a number, found a condition (/definitions/a, column 5)");
  spec["safe"] = "near + 1 < 2";
  EXPECT_EQ(test::error_of(spec), "expected a number, found a condition (/safe, column 1)");
}

TEST(Number, LongChainsOfConstantsAreEvaluated) {
  auto spec = test::example();
  constexpr int kLength = 10'000;
  spec["constants"]["c0"] = 0.5;
  for (int i = 1; i < kLength; ++i) {
    spec["constants"]["c" + std::to_string(i)] = "c" + std::to_string(i - 1) + " + 1";
  }
  spec["dynamics"]["period"] = "c" + std::to_string(kLength - 1);
  EXPECT_EQ(test::read(spec).dynamics.period, Rational(19'999, 2));
}

}  // namespace
}  // namespace coordreq

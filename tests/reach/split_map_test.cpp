#include "reach/split_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reach/flow_helpers.hpp"

namespace coordreq {
namespace {

constexpr std::array<std::uint32_t, 2> kPlaneStates{0, 1};

Interval range_of(const std::string& text, const Interval& x, const Interval& y, double step,
                  std::int64_t effort) {
  const Program program = link(text, look_up_flow, ExpectedType::number, "/test");
  std::vector<Interval> slots(kFlowNames.size(), Interval{1.0, 1.0});
  slots[0] = x;
  slots[1] = y;
  const std::vector<double> steps(slots.size(), 1.0);
  return SplitMap(program, kPlaneStates, steps, {.step = step}, effort).enclose(slots);
}

Interval sampled_range(double (*f)(double, double), const Interval& x, const Interval& y) {
  Interval result(f(x.lower, y.lower));
  for (int a = 0; a <= 200; ++a) {
    for (int b = 0; b <= 200; ++b) {
      result = hull(result, Interval(f(x.lower + a * width(x) / 200, y.lower + b * width(y) / 200)));
    }
  }
  return result;
}

TEST(SplitMap, ComesToWithinACellOfTheRange) {
  const Interval x{-4.5, -3.5};
  const Interval y{-2.5, -1.5};
  const Interval needed =
      sampled_range([](double a, double b) { return 2 * std::sin(a * b / 2) + a * std::cos(b); }, x, y);
  const Interval found = range_of("2*sin(x*y/2) + x*cos(y)", x, y, 0.1, 400);
  EXPECT_LE(found.lower, needed.lower);
  EXPECT_GE(found.upper, needed.upper);
  EXPECT_LE(width(found), width(needed) + 0.2);
  EXPECT_GT(width(range_of("2*sin(x*y/2) + x*cos(y)", x, y, 0.1, 0)), width(needed) + 0.4);
}

TEST(SplitMap, PartsMayBeDefinedWhereTheWholeSeemsNotToBe) {
  const Interval found = range_of("sqrt(x - x^2 + 0.3)", {0.0, 1.0}, {0.0, 0.0}, 0.01, 200);
  EXPECT_TRUE(found.total);
  EXPECT_LE(found.lower, std::sqrt(0.3));
  EXPECT_NEAR(found.lower, std::sqrt(0.3), 0.02);
  EXPECT_NEAR(found.upper, std::sqrt(0.55), 0.02);
  EXPECT_FALSE(range_of("sqrt(x - x^2 - 0.1)", {0.0, 1.0}, {0.0, 0.0}, 0.01, 200).total);
  EXPECT_FALSE(range_of("sqrt(x - x^2 + 0.3)", {0.0, 1.0}, {0.0, 0.0}, 0.01, 0).total);
}

TEST(SplitMap, JumpsStayInTheRange) {
  const Interval found = range_of("floor(3*x) + x*(1 - x)*y", {-1.0, 1.0}, {-1.0, 1.0}, 0.05, 300);
  EXPECT_LE(found.lower, -5.0);
  EXPECT_GE(found.upper, 3.0);
  EXPECT_LE(found.upper, 3.2);
}

TEST(SplitMap, VariablesThatAreNotMentionedAreNotDivided) {
  EXPECT_LE(range_of("x*(1 - x)*(2 - x)", {0.0, 2.0}, {-1e9, 1e9}, 0.05, 60).upper, 0.45);
}

}  // namespace
}  // namespace coordreq

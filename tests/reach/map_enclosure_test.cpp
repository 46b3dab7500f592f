#include "reach/map_enclosure.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "reach/random_flow.hpp"

namespace coordreq {
namespace {

constexpr std::array<std::uint32_t, 3> kBoxes{0, 1, 2};

Interval range_of(const std::string& text, const Interval& x, const Interval& y = {1.0, 1.0}) {
  const Program program = link(text, look_up_flow, ExpectedType::number, "/test");
  std::vector<Interval> slots(kFlowNames.size(), Interval{1.0, 1.0});
  slots[0] = x;
  slots[1] = y;
  return MapEnclosure(program, kBoxes).enclose(slots);
}

void expect_range(const Interval& range, double lower, double upper) {
  EXPECT_LE(range.lower, lower);
  EXPECT_GE(range.upper, upper);
  EXPECT_NEAR(range.lower, lower, 1e-14);
  EXPECT_NEAR(range.upper, upper, 1e-14);
}

TEST(MapEnclosure, AffineMapsHaveTheirExactRangeAlsoWithRepeatedVariables) {
  expect_range(range_of("x - 0.5*(x - y) + 0.25*x", {-1.0, 2.0}, {0.0, 4.0}), -0.75, 3.5);
  expect_range(range_of("3*(x - y) - (2*x - y/4)", {-1.0, 2.0}, {0.0, 4.0}), -12.0, 2.0);
  expect_range(range_of("x - x", {-1.0, 2.0}), 0.0, 0.0);
}

TEST(MapEnclosure, TakesAnyNumberOfVariables) {
  std::string text = "0";
  std::vector<std::uint32_t> boxes;
  for (std::uint32_t i = 0; i < 20; ++i) {
    text += " + 2*s" + std::to_string(i) + " - s" + std::to_string(i);
    boxes.push_back(i);
  }
  const auto look_up = [](std::string_view name) -> Binding {
    return static_cast<std::uint32_t>(std::stoul(std::string(name.substr(1))));
  };
  const Program program = link(text, look_up, ExpectedType::number, "/test");
  const std::vector<Interval> slots(20, Interval{-1.0, 2.0});
  expect_range(MapEnclosure(program, boxes).enclose(slots), -20.0, 40.0);
}

TEST(MapEnclosure, MonotoneMapsHaveTheirExactRange) {
  expect_range(range_of("x + 0.5*sin(x)", {-1.0, 2.0}), -1.0 - 0.5 * std::sin(1.0),
               2.0 + 0.5 * std::sin(2.0));
  expect_range(range_of("x/(x + y)", {1.0, 2.0}, {1.0, 3.0}), 0.25, 2.0 / 3.0);
}

TEST(MapEnclosure, MeanValueFormIsOfSecondOrder) {
  // x - x^2 around its maximum: natural evaluation is off by 2e-2, the mean value form by 2e-4.
  const Interval range = range_of("x - x^2", {0.49, 0.51});
  EXPECT_GE(range.upper, 0.25);
  EXPECT_LE(range.upper - range.lower, 1e-3);
}

TEST(MapEnclosure, UndecidedBranchesGiveTheirHull) {
  expect_range(range_of("if(x > 0, 3, 1)", {-1.0, 1.0}), 1.0, 3.0);
  expect_range(range_of("if(x > 0, x + 3, 1 - x)", {0.5, 1.0}), 3.5, 4.0);
}

TEST(MapEnclosure, TellsWhereItIsUndefined) {
  EXPECT_FALSE(range_of("1/x", {-1.0, 1.0}).total);
  EXPECT_FALSE(range_of("sqrt(x)", {-1.0, 1.0}).total);
  EXPECT_TRUE(range_of("sqrt(x)", {0.0, 1.0}).total);
}

TEST(MapEnclosure, NeverExceedsNaturalEvaluationAndHoldsEveryPoint) {
  EXPECT_TRUE(rc::check([] {
    for (int n = 0; n < 20; ++n) {
      const std::string text = random_field(4, 3, Roughness::discontinuous);
      const Program program = link(text, look_up_flow, ExpectedType::number, "/test");
      const FlowCase random = random_case(Roughness::smooth);
      std::vector<Interval> slots = random.slots;
      for (std::size_t s = kBoxes.size(); s < slots.size(); ++s) slots[s].upper = slots[s].lower;
      const Interval range = MapEnclosure(program, kBoxes).enclose(slots);
      const Interval natural = Evaluator<Interval>(program).number(slots);
      RC_LOG(text);
      RC_ASSERT(range.lower >= natural.lower && range.upper <= natural.upper);
      for (int k = 0; k < 5; ++k) {
        std::vector<Real> point;
        for (const Interval& slot : slots) point.push_back({pick_between(slot.lower, slot.upper)});
        const long double value = Evaluator<Real>(program).number(point).value;
        const long double slack = 1e-14L * (1.0L + std::fabs(value));
        RC_ASSERT(!range.total || (range.lower - slack <= value && value <= range.upper + slack));
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq

#include "expression/dual.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "expression/evaluate.hpp"
#include "reach/random_flow.hpp"

namespace coordreq {
namespace {

Program number(const std::string& text) {
  return link(text, look_up_flow, ExpectedType::number, "/test");
}

Dual dual_of(const Program& program, const std::vector<Interval>& box) {
  std::vector<Dual> slots;
  for (std::size_t j = 0; j < box.size(); ++j) slots.push_back(Dual::variable(box[j], j));
  return Evaluator<Dual>(program).number(slots);
}

Dual of(const std::string& text, const Interval& x) {
  std::vector<Interval> box(kFlowNames.size(), Interval{1.0, 1.0});
  box[0] = x;
  return dual_of(number(text), box);
}

TEST(Dual, DerivativesOfElementaryFunctionsAtAPoint) {
  const auto expect = [](const char* text, double derivative) {
    const Interval gradient = of(text, {0.25, 0.25}).gradient[0];
    EXPECT_NEAR(gradient.lower, derivative, 1e-14) << text;
    EXPECT_NEAR(gradient.upper, derivative, 1e-14) << text;
  };
  expect("x^3", 0.1875);
  expect("x^-2", -128.0);
  expect("x^2.5", 0.3125);
  expect("2^x", std::log(2.0) * std::pow(2.0, 0.25));
  expect("x^x", std::pow(0.25, 0.25) * (std::log(0.25) + 1.0));
  expect("sin(2*x)", 2.0 * std::cos(0.5));
  expect("cos(x)", -std::sin(0.25));
  expect("tan(x)", 1.0 / (std::cos(0.25) * std::cos(0.25)));
  expect("asin(x)", 1.0 / std::sqrt(1.0 - 0.0625));
  expect("acos(x)", -1.0 / std::sqrt(1.0 - 0.0625));
  expect("atan(x)", 1.0 / 1.0625);
  expect("atan2(x, 2)", 0.5 / (1.0 + 0.015625));
  expect("atan2(-2, x - 1)", 2.0 / (4.0 + 0.5625));
  expect("sinh(x)", std::cosh(0.25));
  expect("cosh(x)", std::sinh(0.25));
  expect("tanh(x)", 1.0 - std::tanh(0.25) * std::tanh(0.25));
  expect("exp(x)", std::exp(0.25));
  expect("log(x)", 4.0);
  expect("sqrt(x)", 1.0);
  expect("1/x", -16.0);
  expect("-abs(x)", -1.0);
  expect("min(x, 3*x)", 1.0);
  expect("max(x, 3*x)", 3.0);
  expect("if(x > 0, 5*x, x)", 5.0);
}

TEST(Dual, KinksHaveTheGeneralisedGradient) {
  const Dual magnitude = of("abs(x)", {-1.0, 2.0});
  EXPECT_EQ(magnitude.gradient[0].lower, -1.0);
  EXPECT_EQ(magnitude.gradient[0].upper, 1.0);
  EXPECT_EQ(magnitude.jump.upper, 0.0);
  const Dual larger = of("max(x, 3*x)", {-1.0, 2.0});
  EXPECT_EQ(larger.gradient[0].lower, 1.0);
  EXPECT_EQ(larger.gradient[0].upper, 3.0);
}

TEST(Dual, DiscontinuitiesAreJumps) {
  const Dual branch = of("x + if(x > 0, 4, 1)", {-1.0, 2.0});
  EXPECT_EQ(branch.gradient[0].lower, 1.0);
  EXPECT_EQ(branch.gradient[0].upper, 1.0);
  EXPECT_EQ(branch.jump.lower, -1.5);
  EXPECT_EQ(branch.jump.upper, 1.5);
  EXPECT_EQ(of("3*sign(x)", {-1.0, 2.0}).jump.upper, 3.0);
  EXPECT_EQ(of("3*sign(x)", {1.0, 2.0}).jump.upper, 0.0);
  EXPECT_EQ(of("floor(x)", {-0.5, 2.5}).jump.upper, 1.5);
  EXPECT_EQ(of("floor(x)", {1.25, 1.75}).jump.upper, 0.0);
  EXPECT_GE(of("atan2(x, -1)", {-1.0, 2.0}).jump.upper, 3.1415926535897931);
  EXPECT_EQ(of("atan2(x, -1)", {0.0, 2.0}).jump.upper, 0.0);
  EXPECT_EQ(of("atan2(x, 1)", {-1.0, 2.0}).jump.upper, 0.0);
}

TEST(Dual, UndefinednessIsCarried) {
  EXPECT_FALSE(of("1 + 0*sqrt(x)", {-1.0, 2.0}).total);
  EXPECT_FALSE(of("if(log(x) > 0, 1, 2)", {-1.0, 2.0}).total);
  EXPECT_TRUE(of("if(log(x) > 0, 1, 2)", {0.5, 2.0}).total);
}

TEST(Dual, BoundsEveryDifference) {
  EXPECT_TRUE(rc::check([] {
    for (int n = 0; n < 20; ++n) {
      const std::string text = random_field(3, 3, Roughness::discontinuous);
      const Program program = number(text);
      const FlowCase random = random_case(Roughness::smooth);
      const Dual range = dual_of(program, random.slots);
      if (!range.total) continue;
      std::vector<double> a;
      std::vector<double> b;
      Interval difference{-2.0 * range.jump.upper, 2.0 * range.jump.upper};
      for (std::size_t j = 0; j < random.slots.size(); ++j) {
        a.push_back(pick_between(random.slots[j].lower, random.slots[j].upper));
        b.push_back(pick_between(random.slots[j].lower, random.slots[j].upper));
        if (j < range.directions) {
          difference = difference + range.gradient[j] * (Interval{a[j], a[j]} - Interval{b[j], b[j]});
        }
      }
      const double at_a = Evaluator<double>(program).number(a);
      const double at_b = Evaluator<double>(program).number(b);
      const double slack = 1e-12 * (1.0 + std::fabs(at_a) + std::fabs(at_b));
      RC_LOG(text);
      RC_ASSERT(difference.lower - slack <= at_a - at_b && at_a - at_b <= difference.upper + slack);
    }
  }));
}

}  // namespace
}  // namespace coordreq

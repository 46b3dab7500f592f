#include "expression/condition.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>

#include "support/condition_helpers.hpp"

namespace coordreq {
namespace {

using test::between;
using test::Box;
using test::condition;
using test::decide;
using test::decide_naturally;

/// The cell of width `width` around k * width.
RationalInterval cell(int k, const Rational& width) {
  return between(width * k - width / 2, width * k + width / 2);
}

struct Sampled {
  bool some_true = false;
  bool some_false = false;
};

/// The condition at (steps + 1)^2 points of a box in the plane, corners included, in exact arithmetic.
Sampled sample(const Program& program, const Box& box, int steps) {
  Evaluator<RationalInterval> evaluator(program);
  const auto point = [&](std::size_t i, int step) {
    const Rational value = box[i].lower + (box[i].upper - box[i].lower) * step / steps;
    return between(value, value);
  };
  Sampled result;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Truth truth = evaluator.condition(Box{point(0, i), point(1, j), RationalInterval{}});
      result.some_true = result.some_true || truth == Truth::yes;
      result.some_false = result.some_false || truth == Truth::no;
    }
  }
  return result;
}

TEST(ConditionDecider, ACellThatTouchesTheBorderFromInsideIsIn) {
  EXPECT_EQ(decide("x <= 0.3", {between(Rational(1, 10), Rational(3, 10))}), Truth::yes);
  EXPECT_EQ(decide("x < 0.3", {between(Rational(1, 10), Rational(3, 10))}), Truth::undecided);
  EXPECT_EQ(decide("x^2 + y^2 <= 25", {between(0, 3), between(0, 4)}), Truth::yes);
}

TEST(ConditionDecider, AProductWithItselfIsDecidedUpToItsVeryMaximum) {
  const Program program = condition("x*(1 - x) <= 0.25");
  const Rational width(1, 10);
  int natural = 0;
  for (int k = -5; k <= 15; ++k) {
    EXPECT_EQ(decide(program, {cell(k, width)}), Truth::yes) << k;
    natural += decide_naturally(program, {cell(k, width)}) == Truth::yes ? 1 : 0;
  }
  EXPECT_LT(natural, 21);
  EXPECT_NE(decide("x*(1 - x) < 0.25", {cell(5, width)}), Truth::yes);
}

TEST(ConditionDecider, ASquareInThreeTermsIsExactOnEveryCell) {
  const Program program = condition("x^2 - 2*x*y + y^2 <= 1");
  const Rational width(1, 4);
  int natural = 0;
  int decided = 0;
  for (int i = -12; i <= 12; ++i) {
    for (int j = -12; j <= 12; ++j) {
      const Box box{cell(i, width), cell(j, width)};
      const bool inside =
          std::abs(i - j) + 1 <= 4;  // |x - y| <= 1 at the farthest corner, in units of the width
      EXPECT_EQ(decide(program, box, Question::everywhere) == Truth::yes, inside) << i << " " << j;
      decided += inside ? 1 : 0;
      natural += decide_naturally(program, box) == Truth::yes ? 1 : 0;
    }
  }
  EXPECT_LT(2 * natural, decided);
}

TEST(ConditionDecider, SmallDifferencesOfLargeFunctionsAreSeen) {
  const Program program = condition("abs(sin(x) - x)*(1 + x^2) <= 0.05");
  const Rational width(1, 20);
  for (int k = -20; k <= 20; ++k) {
    const Box box{cell(k, width), between(0, 0), between(0, 0)};
    const Truth truth = decide(program, box);
    // The border lies at |x| = 0.6116..., within the cell of 12 (0.575 to 0.625).
    EXPECT_EQ(truth, std::abs(k) < 12 ? Truth::yes : std::abs(k) > 12 ? Truth::no : Truth::undecided) << k;
  }
  EXPECT_EQ(decide_naturally(program, {cell(8, width)}), Truth::undecided);
}

TEST(ConditionDecider, RegionsThatOnlyTogetherCoverACellAreJoined) {
  const RationalInterval range = between(Rational(1, 2), Rational(3, 2));
  EXPECT_EQ(decide("x <= 1 or x >= 1", {range}), Truth::yes);
  EXPECT_NE(decide("x < 1 or x > 1", {range}), Truth::yes);
  EXPECT_EQ(decide("x < 1.1 or x > 0.9", {range}), Truth::yes);
  EXPECT_EQ(decide("x > 1.1 and x < 0.9", {range}), Truth::no);
}

TEST(ConditionDecider, WhereItIsNotDefinedNothingHoldsEverywhere) {
  EXPECT_NE(decide("sqrt(x) - sqrt(x) >= 0", {between(-1, 1)}), Truth::yes);
  EXPECT_NE(decide("x/x == 1", {between(-1, 1)}), Truth::yes);
  EXPECT_NE(decide("log(x) + x < 10", {between(0, 1)}), Truth::yes);
  EXPECT_EQ(decide("sqrt(x) - x >= 0", {between(0, 1)}), Truth::yes);
}

TEST(ConditionDecider, AConditionThatHoldsOnADiagonalOnlyEndsInTime) {
  const Box box{between(0, 1), between(0, 1), between(0, 1)};
  EXPECT_EQ(decide("x*y - y*x + z - z != x - y", box), Truth::undecided);
}

/// A random polynomial condition with many repetitions; numbers small enough to meet borders exactly.
std::string random_condition() {
  const auto draw = [](int low, int high) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
  };
  const auto atom = [&] {
    static const std::vector<std::string> terms{"x",     "y",     "x*y",        "x^2", "y^2",
                                                "x*x*y", "(x-y)", "abs(x - y)", "x^3", "max(x, y)"};
    const auto term = [&] { return terms[static_cast<std::size_t>(draw(0, 9))]; };
    return fmt::format("{}*{} {} {}*{} {} {} {}/2", draw(-3, 3), term(), draw(0, 1) == 0 ? "+" : "-",
                       draw(1, 3), term(), draw(0, 1) == 0 ? "<=" : ">", term(), draw(-6, 6));
  };
  std::string text = atom();
  text.insert(text.rfind(' '), " +");
  if (draw(0, 2) == 0) return text;
  std::string other = atom();
  other.insert(other.rfind(' '), " +");
  return fmt::format("{} {} {}", text, draw(0, 1) == 0 ? "and" : "or", other);
}

TEST(ConditionDecider, NeverClaimsMoreThanSamplesShowNorLessThanNaturalEvaluation) {
  EXPECT_TRUE(rc::check("sound, and at least natural", [] {
    const Program program = condition(random_condition());
    const auto range = [] {
      const Rational centre = Rational(*rc::gen::inRange(-6, 7)) / 4;
      const Rational radius = Rational(*rc::gen::inRange(1, 5)) / 8;
      return between(centre - radius, centre + radius);
    };
    const Box box{range(), range(), RationalInterval{}};
    const Truth truth = decide(program, box);
    const Sampled samples = sample(program, box, 8);
    const Truth natural = decide_naturally(program, box);
    RC_CLASSIFY(natural == Truth::undecided && truth != Truth::undecided, "sharper");
    RC_CLASSIFY(truth == Truth::undecided && samples.some_true != samples.some_false, "open");
    RC_ASSERT(truth != Truth::yes || !samples.some_false);
    RC_ASSERT(truth != Truth::no || !samples.some_true);
    RC_ASSERT(natural == Truth::undecided || truth == natural);
    RC_ASSERT((decide(program, box, Question::everywhere) == Truth::yes) == (truth == Truth::yes));
  }));
}

}  // namespace
}  // namespace coordreq

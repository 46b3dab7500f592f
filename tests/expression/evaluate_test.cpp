#include "expression/evaluate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

Truth truth_on(std::string_view text, const Interval& x, const Interval& y = {}) {
  const Program program = link_xyz(text, ExpectedType::condition);
  return Evaluator<Interval>(program).condition(std::array{x, y});
}

Interval range_on(std::string_view text, const Interval& x, const Interval& y = {}) {
  const Program program = link_xyz(text, ExpectedType::number);
  return Evaluator<Interval>(program).number(std::array{x, y});
}

TEST(Evaluator, ConditionsOverBoxesFollowKleene) {
  const Interval unit{0.0, 1.0};
  EXPECT_EQ(truth_on("x <= 1", unit), Truth::yes);
  EXPECT_EQ(truth_on("x < 1", unit), Truth::undecided);
  EXPECT_EQ(truth_on("x > 1", unit), Truth::no);
  EXPECT_EQ(truth_on("x < 1 or x >= 0", unit), Truth::yes);
  EXPECT_EQ(truth_on("x < 1 and x > 2", unit), Truth::no);
  EXPECT_EQ(truth_on("not x < 1", unit), Truth::undecided);
  EXPECT_EQ(truth_on("x*x >= 0", {-1.0, 1.0}), Truth::yes);
}

TEST(Evaluator, UndefinedIsUndecidedUnlessItDoesNotMatter) {
  EXPECT_EQ(truth_on("sqrt(x) >= 0", {-1.0, 1.0}), Truth::undecided);
  EXPECT_EQ(truth_on("sqrt(x) >= 0", {-2.0, -1.0}), Truth::undecided);
  EXPECT_EQ(truth_on("1/x > 0", {0.0, 1.0}), Truth::undecided);
  EXPECT_EQ(truth_on("x <= 2 or sqrt(x) >= 0", {-1.0, 1.0}), Truth::yes);
  EXPECT_EQ(truth_on("0 * sqrt(x) == 0", {-1.0, 1.0}), Truth::undecided);
}

TEST(Evaluator, BranchOnSomethingUndefinedIsNotTotal) {
  EXPECT_TRUE(range_on("if(x > 0, 1, 2)", {-1.0, 1.0}).total);
  EXPECT_FALSE(range_on("if(sqrt(x) > 0, 1, 2)", {-1.0, 1.0}).total);
  EXPECT_FALSE(range_on("if(not (sqrt(x) > 0), 1, 2)", {-1.0, 1.0}).total);
  EXPECT_FALSE(range_on("if(sqrt(x) > 0 and x < 5, 1, 2)", {-1.0, 1.0}).total);
  EXPECT_TRUE(range_on("if(sqrt(x) > 0 and x > 5, 1, 2)", {-1.0, 1.0}).total);
  EXPECT_EQ(truth_on("if(sqrt(x) > 0, 1, 2) >= 1", {-1.0, 1.0}), Truth::undecided);
  EXPECT_EQ(truth_at("if(sqrt(x) > 0, 1, 2) >= 1", -1), Truth::undecided);
}

TEST(Evaluator, UnusedBranchMayBeUndefined) {
  EXPECT_EQ(truth_on("if(x > 0, x, sqrt(x - 9)) > 0", {1.0, 2.0}), Truth::yes);
  EXPECT_EQ(truth_on("if(x > 1, x, sqrt(x - 9)) > 0", {1.0, 2.0}), Truth::undecided);
}

TEST(Evaluator, IrrationalConstantsAreEnclosed) {
  const Interval value = range_on("sin(1)*x", {1.0, 1.0});
  EXPECT_LT(value.lower, value.upper);
  EXPECT_TRUE(value.contains(std::sin(1.0)));
  EXPECT_EQ(truth_on("sqrt(2)*sqrt(2) == 2", {}), Truth::undecided);
  EXPECT_EQ(truth_at("x*0.1 == 0.3", 3), Truth::yes);
}

TEST(Evaluator, DoublesComputeAsWritten) {
  const Program program = link_xyz("x^2 + sin(y) / 2 - if(x > y, 1, 2)");
  Evaluator<double> evaluator(program);
  EXPECT_EQ(evaluator.number(std::array{3.0, 1.0}), 9.0 + std::sin(1.0) / 2.0 - 1.0);
  EXPECT_EQ(evaluator.number(std::array{1.0, 3.0}), 1.0 + std::sin(3.0) / 2.0 - 2.0);
  const Program condition = link_xyz("1/x > 0");
  EXPECT_EQ(Evaluator<double>(condition).condition(std::array{0.0}), Truth::undecided);
}

TEST(Evaluator, CanBeRunAgain) {
  const Program program = link_xyz("if(x < 0, -x, sqrt(x))");
  Evaluator<RationalInterval> evaluator(program);
  EXPECT_EQ(evaluator.number(std::array{exactly(-3)}).lower, 3);
  EXPECT_EQ(evaluator.number(std::array{exactly(9)}).lower, 3);
  EXPECT_EQ(evaluator.number(std::array{exactly(Rational(-1, 2))}).upper, Rational(1, 2));
}

}  // namespace
}  // namespace coordreq

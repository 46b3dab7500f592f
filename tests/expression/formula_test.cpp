#include "expression/formula.hpp"

#include <gtest/gtest.h>

#include "support/condition_helpers.hpp"

namespace coordreq {
namespace {

Truth value(const Program& program, const std::vector<Truth>& truths) {
  return take_apart(program).value(truths);
}

TEST(Formula, TakesComparisonsInOrderAndJoinsThemAgain) {
  const Program program = test::condition("x < 1 and not (y >= x or z == 2)");
  const Formula formula = take_apart(program);
  ASSERT_EQ(formula.comparisons.size(), 3U);
  EXPECT_EQ(formula.comparisons[0].op, Operator::less);
  EXPECT_EQ(formula.comparisons[1].op, Operator::greater_equal);
  EXPECT_EQ(formula.comparisons[2].op, Operator::equal);
  EXPECT_EQ(formula.comparisons[1].difference.variables(), (std::vector<std::uint32_t>{0, 1}));
  const Truth yes = Truth::yes;
  const Truth no = Truth::no;
  const Truth open = Truth::undecided;
  EXPECT_EQ(value(program, {yes, no, no}), yes);
  EXPECT_EQ(value(program, {yes, no, yes}), no);
  EXPECT_EQ(value(program, {no, open, open}), no);
  EXPECT_EQ(value(program, {yes, open, no}), open);
}

TEST(Formula, ConstantsAndConditionsInsideOfNumbersStayWhereTheyAre) {
  EXPECT_EQ(value(test::condition("true"), {}), Truth::yes);
  EXPECT_EQ(value(test::condition("1 > 2"), {}), Truth::no);
  const Formula formula = take_apart(test::condition("if(x > 0 and y > 0, x, y) < 3"));
  ASSERT_EQ(formula.comparisons.size(), 3U);
  EXPECT_EQ(formula.value(std::vector<Truth>{Truth::no, Truth::no, Truth::yes}), Truth::yes);
  EXPECT_EQ(formula.comparisons.back().difference.variables(), (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace coordreq

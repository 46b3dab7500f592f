#include "numeric/truth.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

constexpr Truth kNo = Truth::no;
constexpr Truth kYes = Truth::yes;
constexpr Truth kOpen = Truth::undecided;

TEST(Truth, NegationKeepsUndecided) {
  EXPECT_EQ(!kNo, kYes);
  EXPECT_EQ(!kYes, kNo);
  EXPECT_EQ(!kOpen, kOpen);
}

TEST(Truth, AndIsDecidedByANo) {
  EXPECT_EQ(truth_and(kYes, kYes), kYes);
  EXPECT_EQ(truth_and(kYes, kOpen), kOpen);
  EXPECT_EQ(truth_and(kOpen, kOpen), kOpen);
  for (const Truth other : {kNo, kYes, kOpen}) {
    EXPECT_EQ(truth_and(kNo, other), kNo);
    EXPECT_EQ(truth_and(other, kNo), kNo);
  }
}

TEST(Truth, OrIsTheDualOfAnd) {
  for (const Truth a : {kNo, kYes, kOpen}) {
    for (const Truth b : {kNo, kYes, kOpen}) EXPECT_EQ(truth_or(a, b), !truth_and(!a, !b));
  }
}

}  // namespace
}  // namespace coordreq

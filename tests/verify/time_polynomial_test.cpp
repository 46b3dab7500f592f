#include "verify/time_polynomial.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

void expect_floor(const TimePolynomial& p, const Rational& end, std::int64_t floor) {
  const FloorOfLeast found = floor_of_least(p, end);
  EXPECT_EQ(found.inner, floor);
  EXPECT_EQ(found.outer, floor);
}

TEST(FloorOfLeast, MonotoneMotionEndsAtAnEnd) {
  expect_floor({3, -1}, 2, 1);
  expect_floor({Rational(5) / 2, 1, 1}, 2, 2);
  expect_floor({7}, 2, 7);
}

TEST(FloorOfLeast, AParabolaTurnsExactly) {
  // (t - 1/3)^2 + 4: 4 at its vertex, no less, though 1/3 is no dyadic time
  expect_floor({4 + Rational(1) / 9, Rational(-2) / 3, 1}, 1, 4);
  // and a little deeper
  expect_floor({4 + Rational(1) / 9 - Rational(1) / 1000000, Rational(-2) / 3, 1}, 1, 3);
}

TEST(FloorOfLeast, ACubicTurnsAtAnIrrationalTime) {
  // t^3 - t is least at 1/sqrt(3): -0.3849
  expect_floor({Rational(39) / 100, -1, 0, 1}, 1, 0);
  expect_floor({Rational(38) / 100, -1, 0, 1}, 1, -1);
}

TEST(FloorOfLeast, ALeastValueThatNobodyKnowsExactlyIsLeftOpen) {
  // 9 times 27/8 (t^3 - t)^2 >= 0 with its zeros at the ends: least there. -(t^2 - 1/2)^2 + 1/4 >= 0
  // likewise.
  expect_floor({0, 0, 1, 0, -1}, 1, 0);
  // (t^2 - 1/2)^2 = 0 at 1/sqrt(2): the floor is 0, which only the outer bound doubts.
  const FloorOfLeast found = floor_of_least({Rational(1) / 4, 0, -1, 0, 1}, 1);
  EXPECT_EQ(found.inner, 0);
  EXPECT_EQ(found.outer, -1);
}

TEST(SignOn, TellsWhetherItChanges) {
  EXPECT_EQ(sign_on({1, -1}, 1), 1);
  EXPECT_EQ(sign_on({-1, 1}, 1), -1);
  EXPECT_EQ(sign_on({-1, 2}, 1), 0);
  EXPECT_EQ(sign_on({0, 0}, 1), 1);
}

TEST(SwitchingIntegral, SplitsWhereTheSignChanges) {
  const SwitchingIntegral half = integrate_switching({-1, 2}, 1);  // 2s - 1
  EXPECT_EQ(half.value, Rational(1) / 2);
  EXPECT_TRUE(half.exact);
  const SwitchingIntegral third = integrate_switching({-1, 3}, 1);
  EXPECT_EQ(third.value, Rational(5) / 6);
  EXPECT_FALSE(third.exact);  // halving does not find 1/3
}

TEST(SwitchingIntegral, ErrsUpwardsAtAnIrrationalRoot) {
  // |s^2 - 1/2| from 0 to 1 is (2 sqrt(2) - 1) / 6
  const SwitchingIntegral found = integrate_switching({Rational(-1) / 2, 0, 1}, 1);
  EXPECT_FALSE(found.exact);
  const Rational twice_root = 6 * found.value + 1;  // 2 sqrt(2)
  EXPECT_GE(twice_root * twice_root, 8);
  EXPECT_LT(twice_root * twice_root, 8 + Rational(1) / 1000000000);
}

}  // namespace
}  // namespace coordreq

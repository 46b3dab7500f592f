#include "model/sample_reset.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

GridDimension reset_dimension(Outside below, Outside above) {
  return {
      .name = "x", .first = 0, .step = 1, .count = 5, .below = below, .above = above, .lower = 0, .upper = 4};
}

TEST(ResetAtSample, SaturateMovesToTheOutermostGridPointOfItsSide) {
  const GridDimension x = reset_dimension(Outside::saturate, Outside::unsafe);
  EXPECT_EQ(reset_at_sample(x, Rational(-1, 4)), 0);
  EXPECT_EQ(reset_at_sample(x, 9), 9);
  const GridDimension y = reset_dimension(Outside::safe, Outside::saturate);
  EXPECT_EQ(reset_at_sample(y, Rational(17, 4)), 4);
  EXPECT_EQ(reset_at_sample(y, -3), -3);
  EXPECT_EQ(reset_at_sample(y, Rational(7, 2)), Rational(7, 2));
}

TEST(ResetAtSample, StopHasDoneItsWorkInTheDynamics) {
  const GridDimension x = reset_dimension(Outside::stop, Outside::stop);
  EXPECT_EQ(reset_at_sample(x, Rational(9, 2)), Rational(9, 2));
}

TEST(ResetAtSample, PeriodicComesBackIntoThePeriod) {
  GridDimension x = reset_dimension(Outside::periodic, Outside::periodic);
  x.first = x.lower = -2;
  x.upper = 3;
  EXPECT_EQ(reset_at_sample(x, 3), -2);
  EXPECT_EQ(reset_at_sample(x, Rational(-9, 4)), Rational(11, 4));
  EXPECT_EQ(reset_at_sample(x, -2), -2);
  EXPECT_EQ(reset_at_sample(x, Rational(27, 2)), Rational(-3, 2));
}

}  // namespace
}  // namespace coordreq

#include "reach/absolute_integral.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace coordreq {
namespace {

TEST(AbsoluteIntegral, IsExactWhereTheSignIsKept) {
  // 1 + 2s on [0, 3]: 3 + 9.
  const AbsoluteIntegral integral = integral_of_absolute({Rational(1), Rational(2)}, 3);
  EXPECT_EQ(integral.value, Rational(12));
  EXPECT_TRUE(integral.exact);
  EXPECT_EQ(integral_of_absolute({Rational(-1), Rational(-2)}, 3).value, Rational(12));
}

TEST(AbsoluteIntegral, IsExactAtADyadicSignChange) {
  // |1 - 2s| on [0, 1] is two triangles of area 1/4.
  const AbsoluteIntegral integral = integral_of_absolute({Rational(1), Rational(-2)}, 1);
  EXPECT_EQ(integral.value, Rational(1, 2));
  EXPECT_TRUE(integral.exact);
}

TEST(AbsoluteIntegral, IsAnUpperBoundAroundAnIrrationalRoot) {
  // |2 - s^2| on [0, 2] = 4 - 8/3 with the root sqrt(2): 8 sqrt(2) / 3 - 4/3.
  const AbsoluteIntegral integral = integral_of_absolute({Rational(2), Rational(0), Rational(-1)}, 2);
  const double expected = 8 * std::sqrt(2.0) / 3 - 4.0 / 3;
  EXPECT_FALSE(integral.exact);
  EXPECT_GE(integral.value.get_d(), expected - 1e-15);
  EXPECT_LT(integral.value.get_d(), expected + 1e-6);
}

TEST(AbsoluteIntegral, NeverBelowTheRiemannSum) {
  EXPECT_TRUE(rc::check("upper bound", [] {
    std::vector<Rational> coefficient;
    const int degree = *rc::gen::inRange(0, 5);
    for (int k = 0; k <= degree; ++k) coefficient.emplace_back(*rc::gen::inRange(-9, 10));
    const AbsoluteIntegral integral = integral_of_absolute(coefficient, 2);
    const int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double s = (i + 0.5) * 2 / steps;
      double g = 0;
      for (std::size_t k = coefficient.size(); k-- > 0;) g = g * s + coefficient[k].get_d();
      sum += std::abs(g) * 2 / steps;
    }
    RC_ASSERT(integral.value.get_d() > sum - 1e-3);
    RC_ASSERT(integral.value.get_d() < sum + 1e-3);
  }));
}

}  // namespace
}  // namespace coordreq

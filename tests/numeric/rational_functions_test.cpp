#include "numeric/rational_functions.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(IntegerPower, TakesPositiveAndNegativeExponents) {
  EXPECT_EQ(integer_power(Rational(2, 3), 3), Rational(8, 27));
  EXPECT_EQ(integer_power(Rational(-2, 3), 3), Rational(-8, 27));
  EXPECT_EQ(integer_power(Rational(-2, 3), -3), Rational(-27, 8));
  EXPECT_EQ(integer_power(Rational(-2, 3), -2), Rational(9, 4));
  EXPECT_EQ(integer_power(7, 1), Rational(7));
}

TEST(IntegerPower, NegativeBaseWithNegativeExponentIsCanonical) {
  const Rational value = integer_power(-2, -1).value();
  EXPECT_EQ(value.get_num(), -1);
  EXPECT_EQ(value.get_den(), 2);
}

TEST(IntegerPower, KnowsTheSpecialBases) {
  const Rational huge(mpz_class("100000000000000000000000000000001"));
  EXPECT_EQ(integer_power(0, 0), Rational(1));
  EXPECT_EQ(integer_power(0, 5), Rational(0));
  EXPECT_FALSE(integer_power(0, -1).has_value());
  EXPECT_EQ(integer_power(1, huge), Rational(1));
  EXPECT_EQ(integer_power(-1, huge), Rational(-1));
  EXPECT_EQ(integer_power(-1, huge + 1), Rational(1));
}

TEST(IntegerPower, StopsAtItsLimits) {
  EXPECT_TRUE(integer_power(2, 4096).has_value());
  EXPECT_FALSE(integer_power(2, 4097).has_value());
  EXPECT_FALSE(integer_power(Rational(mpz_class(1) << 200), 1000).has_value());
}

TEST(ExactRoot, FindsRationalRoots) {
  EXPECT_EQ(exact_root(Rational(9, 4), 2), Rational(3, 2));
  EXPECT_EQ(exact_root(Rational(27, 8), 3), Rational(3, 2));
  EXPECT_EQ(exact_root(0, 2), Rational(0));
  EXPECT_FALSE(exact_root(2, 2).has_value());
  EXPECT_FALSE(exact_root(Rational(4, 3), 2).has_value());
}

TEST(ExactPower, TakesRootsThatComeOutEven) {
  EXPECT_EQ(exact_power(8, Rational(2, 3)), Rational(4));
  EXPECT_EQ(exact_power(Rational(1, 4), Rational(-1, 2)), Rational(2));
  EXPECT_EQ(exact_power(0, Rational(1, 3)), Rational(0));
  EXPECT_EQ(exact_power(1, Rational(1, 1000000007)), Rational(1));
  EXPECT_FALSE(exact_power(8, Rational(1, 2)).has_value());
  EXPECT_FALSE(exact_power(0, Rational(-1, 3)).has_value());
  EXPECT_FALSE(exact_power(-8, Rational(1, 3)).has_value());
}

}  // namespace
}  // namespace coordreq

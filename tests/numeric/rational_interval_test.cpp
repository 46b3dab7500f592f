#include "numeric/rational_interval.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>

#include "numeric/rational_functions.hpp"

namespace coordreq {
namespace {

RationalInterval between(const Rational& lower, const Rational& upper) {
  return {lower, upper, true, true};
}
RationalInterval point(const Rational& value) {
  return between(value, value);
}

void expect_equal(const RationalInterval& a, const RationalInterval& b) {
  EXPECT_EQ(a.bounded, b.bounded);
  EXPECT_EQ(a.total, b.total);
  if (!a.bounded || !b.bounded) return;
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
}

bool contains(const RationalInterval& a, const Rational& q) {
  return !a.bounded || (a.lower <= q && q <= a.upper);
}

/// A quotient of small numbers, with zero and equal values coming up often.
Rational small_rational() {
  const int numerator = *rc::gen::inRange(-6, 7);
  const int denominator = *rc::gen::inRange(1, 5);
  return Rational(numerator) / Rational(denominator);
}

/// An interval and a rational in it.
struct Sample {
  RationalInterval set;
  Rational point;
};
Sample sample() {
  std::array<Rational, 3> values{small_rational(), small_rational(), small_rational()};
  if (*rc::gen::inRange(0, 3) == 0) values[1] = values[2] = values[0];
  std::sort(values.begin(), values.end());
  return {between(values[0], values[2]), values[1]};
}

TEST(RationalInterval, ArithmeticContainsTheArithmeticOfPoints) {
  EXPECT_TRUE(rc::check([] {
    const Sample a = sample();
    const Sample b = sample();
    RC_ASSERT(contains(a.set + b.set, a.point + b.point));
    RC_ASSERT(contains(a.set - b.set, a.point - b.point));
    RC_ASSERT(contains(a.set * b.set, a.point * b.point));
    RC_ASSERT(contains(-a.set, -a.point));
    RC_ASSERT(contains(abs(a.set), abs(a.point)));
    RC_ASSERT(contains(sign(a.set), sgn(a.point)));
    RC_ASSERT(contains(min(a.set, b.set), std::min(a.point, b.point)));
    RC_ASSERT(contains(max(a.set, b.set), std::max(a.point, b.point)));
    const RationalInterval quotient = a.set / b.set;
    RC_ASSERT(quotient.total == !contains(b.set, 0));
    if (sgn(b.point) != 0) {
      RC_ASSERT(contains(quotient, a.point / b.point));
    }
  }));
}

TEST(RationalInterval, ArithmeticIsTight) {
  EXPECT_TRUE(rc::check([] {
    const Sample a = sample();
    const Sample b = sample();
    const std::array<Rational, 4> corners{a.set.lower * b.set.lower, a.set.lower * b.set.upper,
                                          a.set.upper * b.set.lower, a.set.upper * b.set.upper};
    const RationalInterval product = a.set * b.set;
    RC_ASSERT(product.lower == *std::min_element(corners.begin(), corners.end()));
    RC_ASSERT(product.upper == *std::max_element(corners.begin(), corners.end()));
    const RationalInterval difference = a.set - b.set;
    RC_ASSERT(difference.lower == a.set.lower - b.set.upper && difference.upper == a.set.upper - b.set.lower);
  }));
}

TEST(RationalInterval, IntegerPowersContainThePowersOfPoints) {
  EXPECT_TRUE(rc::check([] {
    const Sample a = sample();
    const Rational n = *rc::gen::inRange(-5, 6);
    const RationalInterval result = pow(a.set, point(n));
    const std::optional<Rational> value = integer_power(a.point, n);
    if (value) {
      RC_ASSERT(contains(result, *value));
    }
    if (!value) {
      RC_ASSERT(!result.total);
    }
    if (result.total && a.set.lower == a.set.upper) {
      RC_ASSERT(result.is_point());
    }
  }));
}

TEST(RationalInterval, EvenPowersKnowTheirSign) {
  expect_equal(pow(between(-2, 3), point(2)), between(0, 9));
  expect_equal(pow(between(-3, -2), point(2)), between(4, 9));
  expect_equal(pow(between(-3, 2), point(3)), between(-27, 8));
  expect_equal(pow(between(2, 3), point(-2)), between(Rational(1, 9), Rational(1, 4)));
  expect_equal(pow(between(-3, 3), point(0)), point(1));
}

TEST(RationalInterval, DivisionByZeroIsUnboundedAndNotTotal) {
  expect_equal(point(1) / between(-1, 1), {0, 0, false, false});
  expect_equal(point(1) / point(0), {0, 0, false, false});
  expect_equal(point(0) / between(-1, 1), {0, 0, false, true});
  expect_equal(point(1) / between(2, 3), between(Rational(1, 3), Rational(1, 2)));
}

TEST(RationalInterval, UnboundedTimesZeroIsZero) {
  const RationalInterval line{0, 0, true, false};
  expect_equal(line * point(0), point(0));
  EXPECT_FALSE((line * point(2)).bounded);
  EXPECT_FALSE((line + point(2)).bounded);
  EXPECT_FALSE((line - point(2)).bounded);
  expect_equal(sign(line), between(-1, 1));
}

TEST(RationalInterval, RootsOfSquaresAreExact) {
  expect_equal(sqrt(between(Rational(1, 9), Rational(4, 25) + 4)),
               between(Rational(1, 3), sqrt(point(Rational(4, 25) + 4)).upper));
  expect_equal(sqrt(between(4, Rational(25, 4))), between(2, Rational(5, 2)));
  expect_equal(pow(point(8), point(Rational(1, 3))), point(2));
  expect_equal(pow(between(4, 9), point(Rational(1, 2))), between(2, 3));
}

TEST(RationalInterval, IrrationalRootsAreEnclosed) {
  const RationalInterval root = sqrt(point(2));
  EXPECT_LT(root.lower * root.lower, 2);
  EXPECT_GT(root.upper * root.upper, 2);
  EXPECT_LT(root.upper - root.lower, Rational(1, 1000000000));
}

TEST(RationalInterval, RootsOfNegativeNumbersAreNotTotal) {
  EXPECT_FALSE(sqrt(between(-1, 4)).total);
  EXPECT_EQ(sqrt(between(-1, 4)).upper, 2);
  EXPECT_FALSE(sqrt(point(-1)).bounded);
}

TEST(RationalInterval, SizeIsLimited) {
  RationalInterval a = point(Rational(1, 3));
  for (int i = 0; i < 100; ++i) a = a * a + point(Rational(1, 7));
  EXPECT_TRUE(a.bounded);
  EXPECT_LE(bit_size(a.lower), kMostRationalBits);
  EXPECT_LE(a.lower, a.upper);
  RationalInterval upward{.lower = 0, .upper = Rational(1, 3)};  // only one end grows
  for (int i = 0; i < 100; ++i)
    upward = upward * upward + RationalInterval{.lower = 0, .upper = Rational(1, 7)};
  EXPECT_LE(bit_size(upward.upper), kMostRationalBits);
  const RationalInterval power = pow(point(Rational(3, 2)), point(5000));
  EXPECT_FALSE(power.bounded);
  const RationalInterval small = pow(point(Rational(1001, 1000)), point(5000));
  EXPECT_TRUE(small.bounded);
  EXPECT_LT(small.lower, small.upper);
}

TEST(RationalInterval, HugePowersEndQuickly) {
  RationalInterval a = point(3);
  for (int i = 0; i < 20; ++i) a = pow(a, point(4000));
  EXPECT_FALSE(a.bounded);
}

}  // namespace
}  // namespace coordreq

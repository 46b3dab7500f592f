#include <gtest/gtest.h>

#include "numeric/big_value.hpp"
#include "numeric/interval.hpp"
#include "numeric/random_doubles.hpp"

namespace coordreq {
namespace {

constexpr int kPowerSamples = 200'000;
constexpr double kPowerInf = outward::kInfinity;

void expect_equal(const Interval& a, const Interval& b) {
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.total, b.total);
}

void expect_encloses_power(BigValue& value, const Interval& a, const Interval& b, double x, double y) {
  const Interval result = pow(a, b);
  ASSERT_LE(result.lower, result.upper);
  value.set(mpfr_pow, x, y);
  if (!value.is_defined()) {
    ASSERT_FALSE(result.total) << x << '^' << y;
    return;
  }
  ASSERT_TRUE(value.is_at_least(result.lower) && value.is_at_most(result.upper))
      << x << '^' << y << " with base [" << a.lower << ", " << a.upper << "] and exponent [" << b.lower
      << ", " << b.upper << "]";
}

TEST(Power, IntegerPowersContainThePowersOfPoints) {
  RandomDoubles random(30);
  BigValue value;
  for (int i = 0; i < kPowerSamples; ++i) {
    const Interval a = random.interval();
    const double n = random.integer(0, 9) == 0 ? random.integer(-400, 400) : random.integer(-9, 9);
    ASSERT_NO_FATAL_FAILURE(expect_encloses_power(value, a, {n, n}, random.within(a), n));
  }
}

TEST(Power, GeneralPowersContainThePowersOfPoints) {
  RandomDoubles random(31);
  BigValue value;
  for (int i = 0; i < kPowerSamples; ++i) {
    const Interval a = random.interval();
    const Interval b = random.interval();
    double y = random.within(b);
    // Integers are where a negative base is defined.
    if (random.integer(0, 1) == 0 && b.contains(std::floor(y))) y = std::floor(y);
    ASSERT_NO_FATAL_FAILURE(expect_encloses_power(value, a, b, random.within(a), y));
  }
}

TEST(Power, EvenPowersKnowTheirSign) {
  expect_equal(power({-2.0, 3.0}, 2.0), {0.0, 9.0});
  expect_equal(power({-3.0, 2.0}, 4.0), {0.0, 81.0});
  expect_equal(power({-3.0, -2.0}, 2.0), {4.0, 9.0});
  expect_equal(power({-3.0, 2.0}, 3.0), {-27.0, 8.0});
  expect_equal(sqr({-3.0, 2.0}), {0.0, 9.0});
}

TEST(Power, ExactPowersStayExact) {
  expect_equal(power({3.0, 3.0}, 20.0), {3486784401.0, 3486784401.0});
  expect_equal(power({2.0, 2.0}, 64.0), {0x1p64, 0x1p64});
  expect_equal(power({2.0, 2.0}, -3.0), {0.125, 0.125});
  expect_equal(power({-0.5, -0.5}, 7.0), {-0.0078125, -0.0078125});
}

TEST(Power, ZeroToTheZeroIsOne) {
  expect_equal(power({0.0, 0.0}, 0.0), {1.0, 1.0});
  expect_equal(power({-1.0, 2.0}, 0.0), {1.0, 1.0});
  expect_equal(pow({0.0, 0.0}, {0.0, 0.0}), {1.0, 1.0});
  expect_equal(pow({0.0, 0.0}, {0.0, 1.0}), {0.0, 1.0});
}

TEST(Power, NegativePowersAcrossZeroAreNotTotal) {
  expect_equal(power({-2.0, 4.0}, -2.0), {0.0625, kPowerInf, false});
  expect_equal(power({-2.0, 4.0}, -1.0), {-kPowerInf, kPowerInf, false});
  expect_equal(power({0.0, 4.0}, -1.0), {0.25, kPowerInf, false});
  expect_equal(power({0.0, 0.0}, -1.0), {-kPowerInf, kPowerInf, false});
  EXPECT_TRUE(power({1e-300, 1.0}, -3.0).total);
}

TEST(Power, NegativeBaseNeedsAnIntegerExponent) {
  expect_equal(pow({-2.0, -1.0}, {0.25, 0.75}), {-kPowerInf, kPowerInf, false});
  EXPECT_FALSE(pow({-1.0, 4.0}, {1.5, 1.5}).total);
  const Interval across = pow({-2.0, -2.0}, {0.5, 1.5});
  EXPECT_FALSE(across.total);
  EXPECT_TRUE(across.contains(-2.0));
}

TEST(Power, HalfIsTheSquareRoot) {
  expect_equal(pow({4.0, 9.0}, {0.5, 0.5}), {2.0, 3.0});
  expect_equal(pow({-1.0, 9.0}, {0.5, 0.5}), {0.0, 3.0, false});
}

TEST(Power, GeneralPowersAreNarrow) {
  RandomDoubles random(32);
  BigValue value;
  for (int i = 0; i < kPowerSamples / 20; ++i) {
    const double x = random.uniform(0.01, 10.0);
    const double y = random.uniform(-20.0, 20.0);
    const Interval result = pow({x, x}, {y, y});
    value.set(mpfr_pow, x, y);
    ASSERT_TRUE(result.total);
    ASSERT_GE(result.lower, outward::moved(value.nearest(), -12));
    ASSERT_LE(result.upper, outward::moved(value.nearest(), 12));
  }
}

}  // namespace
}  // namespace coordreq

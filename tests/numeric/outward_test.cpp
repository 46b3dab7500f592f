#include "numeric/outward.hpp"

#include <gtest/gtest.h>

#include "numeric/random_doubles.hpp"
#include "numeric/rational.hpp"

namespace coordreq {
namespace {

constexpr int kOutwardSamples = 100'000;

/// Both bounds hold, and are one and the same double where the exact value is a double of ordinary size.
void expect_bounds(double below, double above, const Rational& value, bool ordinary) {
  EXPECT_TRUE(below == -outward::kInfinity || exact(below) <= value);
  EXPECT_TRUE(above == outward::kInfinity || exact(above) >= value);
  if (!ordinary) return;
  const double nearest = nearest_double(value);
  EXPECT_LE(outward::next_down(nearest), below);
  EXPECT_GE(outward::next_up(nearest), above);
  if (std::isfinite(nearest) && exact(nearest) == value) {
    EXPECT_EQ(below, nearest);
    EXPECT_EQ(above, nearest);
  }
}

bool is_ordinary(const Rational& value) {
  return abs(value) >= exact(outward::kSafeMagnitude) && abs(value) <= exact(outward::kLargest);
}

TEST(Outward, SumsAreBoundedTightly) {
  RandomDoubles random(1);
  for (int i = 0; i < kOutwardSamples; ++i) {
    const double a = random.any();
    const double b = random.any();
    expect_bounds(outward::add_down(a, b), outward::add_up(a, b), exact(a) + exact(b), std::isfinite(a + b));
  }
}

TEST(Outward, ProductsAreBoundedTightly) {
  RandomDoubles random(2);
  for (int i = 0; i < kOutwardSamples; ++i) {
    const double a = random.any();
    const double b = random.any();
    const Rational value = exact(a) * exact(b);
    expect_bounds(outward::multiply_down(a, b), outward::multiply_up(a, b), value, is_ordinary(value));
  }
}

TEST(Outward, QuotientsAreBoundedTightly) {
  RandomDoubles random(3);
  for (int i = 0; i < kOutwardSamples; ++i) {
    const double a = random.any();
    const double b = random.any();
    if (b == 0.0) continue;
    const Rational value = exact(a) / exact(b);
    expect_bounds(outward::divide_down(a, b), outward::divide_up(a, b), value,
                  is_ordinary(value) && is_ordinary(exact(a)));
  }
}

TEST(Outward, SquareRootsAreBoundedTightly) {
  RandomDoubles random(4);
  for (int i = 0; i < kOutwardSamples; ++i) {
    const double a = std::fabs(random.any());
    const double below = outward::square_root_down(a);
    const double above = outward::square_root_up(a);
    EXPECT_LE(exact(below) * exact(below), exact(a));
    EXPECT_GE(exact(above) * exact(above), exact(a));
    EXPECT_LE(above, outward::moved(below, 2));
  }
  EXPECT_EQ(outward::square_root_down(9.0), 3.0);
  EXPECT_EQ(outward::square_root_up(9.0), 3.0);
  EXPECT_EQ(outward::square_root_down(2.25), 1.5);
  EXPECT_EQ(outward::square_root_up(2.25), 1.5);
}

TEST(Outward, PositiveResultsStayNonnegativeWhenTheyUnderflow) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(outward::multiply_down(least, least), 0.0);
  EXPECT_EQ(outward::multiply_up(least, least), least);
  EXPECT_EQ(outward::multiply_up(-least, least), 0.0);
  EXPECT_EQ(outward::divide_down(least, 1e300), 0.0);
}

TEST(Outward, OverflowIsBoundedByTheLargestDouble) {
  EXPECT_EQ(outward::add_down(outward::kLargest, outward::kLargest), outward::kLargest);
  EXPECT_EQ(outward::add_up(outward::kLargest, outward::kLargest), outward::kInfinity);
  EXPECT_EQ(outward::multiply_down(1e300, 1e300), outward::kLargest);
  EXPECT_EQ(outward::multiply_up(1e300, -1e300), -outward::kLargest);
  EXPECT_EQ(outward::multiply_down(1e300, -1e300), -outward::kInfinity);
}

TEST(Outward, MovingCrossesZeroAndStopsAtInfinity) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(outward::moved(least, -2), -least);
  EXPECT_EQ(outward::moved(-0.0, 1), least);
  EXPECT_EQ(outward::moved(outward::kLargest, 5), outward::kInfinity);
  EXPECT_EQ(outward::moved(-outward::kInfinity, -1), -outward::kInfinity);
  EXPECT_EQ(outward::next_down(outward::kInfinity), outward::kLargest);
  EXPECT_EQ(outward::next_up(1.0), std::nextafter(1.0, 2.0));
  EXPECT_EQ(outward::next_up(-1.0), std::nextafter(-1.0, 0.0));
}

}  // namespace
}  // namespace coordreq

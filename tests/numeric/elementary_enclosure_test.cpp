#include <gtest/gtest.h>

#include <string>

#include "numeric/big_value.hpp"
#include "numeric/interval.hpp"
#include "numeric/random_doubles.hpp"

namespace coordreq {
namespace {

constexpr int kElementarySamples = 400'000;  ///< a function; with the powers five million in all

struct Elementary {
  std::string name;
  Interval (*enclosure)(const Interval&);
  BigValue::Unary reference;
  double least = -outward::kInfinity;  ///< of its range
  double greatest = outward::kInfinity;
};

std::string name_of(const testing::TestParamInfo<Elementary>& info) {
  return info.param.name;
}

class ElementaryEnclosure : public testing::TestWithParam<Elementary> {};

/// Sines of 1e300 take MPFR a thousand bits of pi each, so most arguments are of moderate size.
Interval argument(RandomDoubles& random) {
  if (random.integer(0, 9) == 0) return random.interval();
  const double centre = random.integer(0, 1) == 0 ? random.uniform(-2.0, 2.0) : random.uniform(-800.0, 800.0);
  const double width = random.integer(0, 3) == 0 ? 0.0 : random.uniform(0.0, 3.5);
  return {centre, centre + width};
}

TEST_P(ElementaryEnclosure, ContainsTheValueAtEveryPoint) {
  RandomDoubles random(20);
  BigValue value;
  for (int i = 0; i < kElementarySamples; ++i) {
    const Interval a = argument(random);
    const double x = random.within(a);
    const Interval result = GetParam().enclosure(a);
    value.set(GetParam().reference, x);
    ASSERT_LE(result.lower, result.upper);
    if (!value.is_defined()) {
      ASSERT_FALSE(result.total) << x;
      continue;
    }
    ASSERT_TRUE(value.is_at_least(result.lower) && value.is_at_most(result.upper))
        << x << " in [" << a.lower << ", " << a.upper << "]";
    ASSERT_GE(result.lower, GetParam().least);
    ASSERT_LE(result.upper, GetParam().greatest);
  }
}

TEST(Angle, ContainsTheValueAtEveryPoint) {
  RandomDoubles random(22);
  BigValue value;
  for (int i = 0; i < kElementarySamples; ++i) {
    const Interval y = i % 2 == 0 ? argument(random) : random.interval();
    const Interval x = i % 2 == 0 ? argument(random) : random.interval();
    const double up = random.within(y) + 0.0, right = random.within(x) + 0.0;
    const Interval result = atan2(y, x);
    ASSERT_LE(result.lower, result.upper);
    ASSERT_EQ(result.total, !(y.contains(0.0) && x.contains(0.0)));
    if (up == 0.0 && right == 0.0) continue;
    value.set(mpfr_atan2, up, right);
    ASSERT_TRUE(value.is_at_least(result.lower) && value.is_at_most(result.upper))
        << up << ", " << right << " in " << y.lower << ", " << y.upper << ", " << x.lower << ", " << x.upper;
  }
}

TEST(Angle, IsTightAwayFromTheCut) {
  const Interval quarter = atan2({1.0, 2.0}, {-1.0, 1.0});
  EXPECT_NEAR(quarter.lower, std::atan2(1.0, 1.0), 1e-14);
  EXPECT_NEAR(quarter.upper, std::atan2(1.0, -1.0), 1e-14);
  EXPECT_EQ(atan2({0.0, 0.0}, {1.0, 2.0}).magnitude(), 0.0);
  EXPECT_NEAR(atan2({0.0, 0.0}, {-2.0, -1.0}).lower, std::acos(-1.0), 1e-14);
  EXPECT_NEAR(atan2({-1.0, -0.5}, {-2.0, -1.0}).lower, std::atan2(-0.5, -2.0), 1e-14);
  EXPECT_FALSE(atan2({0.0, 1.0}, {0.0, 1.0}).total);
}

TEST_P(ElementaryEnclosure, IsNarrowAtPoints) {
  RandomDoubles random(21);
  BigValue value;
  for (int i = 0; i < kElementarySamples / 40; ++i) {
    const double x = random.uniform(-5.0, 5.0);
    value.set(GetParam().reference, x);
    if (!value.is_defined()) continue;
    const Interval result = GetParam().enclosure({x, x});
    ASSERT_TRUE(result.total);
    ASSERT_GE(result.lower, outward::moved(value.nearest(), -12)) << x;
    ASSERT_LE(result.upper, outward::moved(value.nearest(), 12)) << x;
  }
}

TEST_P(ElementaryEnclosure, IsNotMuchWiderThanTheValuesAtItsEnds) {
  RandomDoubles random(22);
  for (int i = 0; i < kElementarySamples / 40; ++i) {
    const double x = random.uniform(-0.9, 0.8);
    const Interval a{x, x + 1e-7};
    const Interval result = GetParam().enclosure(a);
    if (!result.total) continue;
    const Interval ends =
        hull(GetParam().enclosure({a.lower, a.lower}), GetParam().enclosure({a.upper, a.upper}));
    ASSERT_LE(result.upper - result.lower, (ends.upper - ends.lower) * 1.001 + 1e-13) << x;
  }
}

constexpr double kHalfPiAbove = 0x1.921fb54442d19p+0;

INSTANTIATE_TEST_SUITE_P(
    All, ElementaryEnclosure,
    testing::Values(Elementary{"sqrt", sqrt, mpfr_sqrt}, Elementary{"exp", exp, mpfr_exp, 0.0},
                    Elementary{"log", log, mpfr_log}, Elementary{"sin", sin, mpfr_sin, -1.0, 1.0},
                    Elementary{"cos", cos, mpfr_cos, -1.0, 1.0}, Elementary{"tan", tan, mpfr_tan},
                    Elementary{"asin", asin, mpfr_asin, -kHalfPiAbove, kHalfPiAbove},
                    Elementary{"acos", acos, mpfr_acos, 0.0, 2 * kHalfPiAbove},
                    Elementary{"atan", atan, mpfr_atan, -kHalfPiAbove, kHalfPiAbove},
                    Elementary{"sinh", sinh, mpfr_sinh}, Elementary{"cosh", cosh, mpfr_cosh, 1.0},
                    Elementary{"tanh", tanh, mpfr_tanh, -1.0, 1.0}),
    name_of);

}  // namespace
}  // namespace coordreq

#include "numeric/upward_interval.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "numeric/random_doubles.hpp"
#include "numeric/rational.hpp"

namespace coordreq {
namespace {

constexpr int kUpwardSamples = 100'000;

using Operation = UpwardInterval (*)(const UpwardInterval&, const UpwardInterval&);

UpwardInterval apply_upward(const Interval& a, const Interval& b, Operation operation) {
  const UpwardInterval first(a);
  const UpwardInterval second(b);
  UpwardInterval result;
  rounded_upward([&] { result = operation(first, second); });
  return result;
}

UpwardInterval sum(const UpwardInterval& a, const UpwardInterval& b) {
  return a + b;
}
UpwardInterval difference(const UpwardInterval& a, const UpwardInterval& b) {
  return a - b;
}
UpwardInterval multiple(const UpwardInterval& a, const UpwardInterval& b) {
  return a * b;
}
UpwardInterval scaled(const UpwardInterval& a, const UpwardInterval& b) {
  return a * b.upper();
}
UpwardInterval quotient(const UpwardInterval& a, const UpwardInterval& b) {
  return a / b;
}

/// The results for all pairs of ends, exactly.
template <class Exactly>
void expect_tightest(const Interval& a, const Interval& b, const UpwardInterval& result, Exactly exactly) {
  if (!a.is_finite() || !b.is_finite()) return;
  Rational least = exactly(exact(a.lower), exact(b.lower));
  Rational greatest = least;
  for (const double x : {a.lower, a.upper}) {
    for (const double y : {b.lower, b.upper}) {
      const Rational value = exactly(exact(x), exact(y));
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
  }
  ASSERT_EQ(result.lower(), lower_double(least))
      << a.lower << ' ' << a.upper << ' ' << b.lower << ' ' << b.upper;
  ASSERT_EQ(result.upper(), upper_double(greatest))
      << a.lower << ' ' << a.upper << ' ' << b.lower << ' ' << b.upper;
}

/// What Interval says holds the result, and exact values of points are within it.
template <class Exactly>
void expect_within(const Interval& a, const Interval& b, const Interval& plain, const UpwardInterval& result,
                   Exactly exactly, RandomDoubles& random) {
  ASSERT_LE(plain.lower, result.lower()) << a.lower << ' ' << a.upper << ' ' << b.lower << ' ' << b.upper;
  ASSERT_GE(plain.upper, result.upper()) << a.lower << ' ' << a.upper << ' ' << b.lower << ' ' << b.upper;
  ASSERT_LT(result.lower(), outward::kInfinity);
  ASSERT_GT(result.upper(), -outward::kInfinity);
  const Rational value = exactly(exact(random.within(a)), exact(random.within(b)));
  ASSERT_TRUE(result.lower() == -outward::kInfinity || exact(result.lower()) <= value);
  ASSERT_TRUE(result.upper() == outward::kInfinity || exact(result.upper()) >= value);
}

template <class Exactly>
void expect_enclosure(Operation operation, Interval (*plain)(const Interval&, const Interval&),
                      Exactly exactly, bool without_zero, std::uint64_t seed) {
  RandomDoubles random(seed);
  for (int i = 0; i < kUpwardSamples; ++i) {
    const Interval a = random.interval();
    const Interval b = random.interval();
    if (without_zero && b.contains(0.0)) continue;
    const UpwardInterval result = apply_upward(a, b, operation);
    expect_within(a, b, plain(a, b), result, exactly, random);
    expect_tightest(a, b, result, exactly);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(UpwardInterval, SumsAreTheTightest) {
  const auto plain = [](const Interval& a, const Interval& b) { return a + b; };
  expect_enclosure(
      sum, plain, [](const Rational& a, const Rational& b) -> Rational { return a + b; }, false, 1);
}

TEST(UpwardInterval, DifferencesAreTheTightest) {
  const auto plain = [](const Interval& a, const Interval& b) { return a - b; };
  expect_enclosure(
      difference, plain, [](const Rational& a, const Rational& b) -> Rational { return a - b; }, false, 2);
}

TEST(UpwardInterval, ProductsAreTheTightest) {
  const auto plain = [](const Interval& a, const Interval& b) { return a * b; };
  expect_enclosure(
      multiple, plain, [](const Rational& a, const Rational& b) -> Rational { return a * b; }, false, 3);
}

TEST(UpwardInterval, QuotientsAreTheTightest) {
  const auto plain = [](const Interval& a, const Interval& b) { return a / b; };
  expect_enclosure(
      quotient, plain, [](const Rational& a, const Rational& b) -> Rational { return a / b; }, true, 4);
}

TEST(UpwardInterval, MultiplesByAPointAreTheTightest) {
  RandomDoubles random(5);
  const auto exactly = [](const Rational& a, const Rational& b) -> Rational { return a * b; };
  for (int i = 0; i < kUpwardSamples; ++i) {
    const Interval a = random.interval();
    const Interval b(random.any());
    const UpwardInterval result = apply_upward(a, b, scaled);
    expect_within(a, b, a * b, result, exactly, random);
    expect_tightest(a, b, result, exactly);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(UpwardInterval, ZeroTimesInfinityIsZero) {
  const Interval infinity[] = {whole_line(true), {1.0, outward::kInfinity}, {-outward::kInfinity, -1.0}};
  for (const Interval& a : infinity) {
    for (const Interval& zero : {Interval(0.0), Interval(-0.0)}) {
      EXPECT_TRUE(apply_upward(a, zero, multiple).is_zero());
      EXPECT_TRUE(apply_upward(zero, a, multiple).is_zero());
      EXPECT_TRUE(apply_upward(a, zero, scaled).is_zero());
    }
    const UpwardInterval unit = apply_upward(a, {0.0, 1.0}, multiple);
    EXPECT_EQ(unit.lower(), std::min(a.lower, 0.0));
    EXPECT_EQ(unit.upper(), std::max(a.upper, 0.0));
  }
}

TEST(UpwardInterval, PartsAndHullsAreThoseOfInterval) {
  RandomDoubles random(6);
  const auto same = [](const UpwardInterval& a, const Interval& b) {
    return a.lower() == b.lower && a.upper() == b.upper;
  };
  for (int i = 0; i < 10'000; ++i) {
    const Interval a = random.interval();
    const Interval b = random.interval();
    const Interval zero(0.0);
    EXPECT_TRUE(same(hull(UpwardInterval(a), UpwardInterval(b)), hull(a, b)));
    EXPECT_TRUE(same(hull_with_zero(UpwardInterval(a)), hull(a, zero)));
    EXPECT_TRUE(same(intersection(UpwardInterval(a), UpwardInterval(b)), intersect(a, b).value_or(a)));
    EXPECT_TRUE(same(positive_part(UpwardInterval(a)), max(a, zero)));
    EXPECT_TRUE(same(negative_part(UpwardInterval(a)), min(a, zero)));
    EXPECT_TRUE(same(-UpwardInterval(a), -a));
    EXPECT_EQ(UpwardInterval(a).magnitude(), a.magnitude());
    EXPECT_EQ(UpwardInterval(a).is_finite(), a.is_finite());
    EXPECT_EQ(UpwardInterval(a).contains_zero(), a.contains(0.0));
  }
}

/// 1 / 3, in the direction in which this thread rounds now.
double third() {
  volatile double one = 1.0;
  volatile double three = 3.0;
  return one / three;
}

TEST(RoundingGuard, RoundsAsToldAndAsBeforeAfterwards) {
  const double nearest = third();
  double upward = 0.0;
  double within = 0.0;
  double again = 0.0;
  rounded_upward([&] {
    upward = third();
    rounded_to_nearest([&] { within = third(); });
    again = third();
  });
  EXPECT_EQ(upward, outward::next_up(nearest));
  EXPECT_EQ(within, nearest);
  EXPECT_EQ(again, upward);
  EXPECT_EQ(third(), nearest);
}

TEST(RoundingGuard, ExceptionsLeaveTheRoundingAsItWas) {
  const double nearest = third();
  EXPECT_THROW(rounded_upward([] { throw std::runtime_error("on the way"); }), std::runtime_error);
  EXPECT_EQ(third(), nearest);
}

}  // namespace
}  // namespace coordreq

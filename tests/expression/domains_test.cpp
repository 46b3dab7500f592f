#include "expression/domains.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace coordreq {
namespace {

constexpr std::array kComparisons{Operator::less,          Operator::less_equal, Operator::greater,
                                  Operator::greater_equal, Operator::equal,      Operator::not_equal};

bool holds(Operator op, int a, int b) {
  switch (op) {
    case Operator::less:
      return a < b;
    case Operator::less_equal:
      return a <= b;
    case Operator::greater:
      return a > b;
    case Operator::greater_equal:
      return a >= b;
    case Operator::equal:
      return a == b;
    default:
      return a != b;
  }
}

/// A comparison of all pairs of the integers a0..a1 and b0..b1; dense enough to tell as much as the reals do.
Truth by_enumeration(Operator op, int a0, int a1, int b0, int b1) {
  bool some = false;
  bool all = true;
  for (int a = a0; a <= a1; ++a) {
    for (int b = b0; b <= b1; ++b) {
      some = some || holds(op, a, b);
      all = all && holds(op, a, b);
    }
  }
  return all ? Truth::yes : some ? Truth::undecided : Truth::no;
}

TEST(Compare, DecidesWhatHoldsForAllPairs) {
  for (int a0 = 0; a0 < 5; ++a0) {
    for (int a1 = a0; a1 < 5; ++a1) {
      for (int b0 = 0; b0 < 5; ++b0) {
        for (int b1 = b0; b1 < 5; ++b1) {
          for (const Operator op : kComparisons) {
            const Truth expected = by_enumeration(op, a0, a1, b0, b1);
            const Interval a{double(a0), double(a1)};
            const Interval b{double(b0), double(b1)};
            EXPECT_EQ(compare(op, a, b), expected);
            EXPECT_EQ(compare(op, to_rational(a), to_rational(b)), expected);
          }
        }
      }
    }
  }
}

TEST(Compare, WhatIsNotTotalIsUndecided) {
  const Interval partial{1.0, 2.0, false};
  const Interval above{5.0, 6.0};
  for (const Operator op : kComparisons) {
    EXPECT_EQ(compare(op, partial, above), Truth::undecided);
    EXPECT_EQ(compare(op, above, partial), Truth::undecided);
    EXPECT_EQ(compare(op, to_rational(partial), to_rational(above)), Truth::undecided);
    EXPECT_EQ(compare(op, to_rational(whole_line(true)), to_rational(above)), Truth::undecided);
    EXPECT_EQ(compare(op, std::nan(""), 1.0), Truth::undecided);
  }
}

TEST(Compare, HalfLinesCanBeDecided) {
  const Interval half_line{1.0, outward::kInfinity};
  EXPECT_EQ(compare(Operator::greater, half_line, Interval{0.0, 0.5}), Truth::yes);
  EXPECT_EQ(compare(Operator::less, half_line, Interval{0.0, 0.5}), Truth::no);
  EXPECT_EQ(compare(Operator::less, half_line, Interval{0.0, 5.0}), Truth::undecided);
}

TEST(Select, UndecidedTakesBothBranches) {
  const Interval both = select(Truth::undecided, Interval{0.0, 1.0}, Interval{3.0, 4.0});
  EXPECT_EQ(both.lower, 0.0);
  EXPECT_EQ(both.upper, 4.0);
  EXPECT_TRUE(both.total);
  EXPECT_EQ(select(Truth::yes, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(Truth::no, 1.0, 2.0), 2.0);
  EXPECT_TRUE(std::isnan(select(Truth::undecided, 1.0, 2.0)));
}

TEST(DoubleDomain, UndefinedIsNaN) {
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan(apply(Operator::divide, 1.0, 0.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::logarithm, 0.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::square_root, -1.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::power, 0.0, -1.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::power, -2.0, 0.5)));
  EXPECT_TRUE(std::isnan(apply(Operator::power, nan, 0.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::power, 1.0, nan)));
  EXPECT_TRUE(std::isnan(apply(Operator::minimum, nan, 1.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::minimum, 1.0, nan)));
  EXPECT_TRUE(std::isnan(apply(Operator::maximum, nan, 1.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::maximum, 1.0, nan)));
  EXPECT_TRUE(std::isnan(apply(Operator::sign, nan)));
  EXPECT_TRUE(std::isnan(apply(Operator::floor, nan)));
  EXPECT_TRUE(std::isnan(apply(Operator::angle, nan, 1.0)));
  EXPECT_TRUE(std::isnan(apply(Operator::angle, 1.0, nan)));
  EXPECT_TRUE(std::isnan(apply(Operator::angle, 0.0, -0.0)));
}

/// Every function in three domains at one point: the double lies near the enclosures, and they contain each
/// other.
TEST(Domains, AgreeOnEveryFunction) {
  const Rational q(3, 8);
  const Rational r(5, 4);
  for (auto op = Operator::negate; op <= Operator::floor; op = Operator(int(op) + 1)) {
    const double value = apply(op, 0.375);
    const Interval enclosure = apply(op, Interval{0.375, 0.375});
    const RationalInterval exact_enclosure = apply(op, RationalInterval{q, q});
    EXPECT_TRUE(enclosure.contains(value)) << spelling(op);
    EXPECT_LT(enclosure.upper - enclosure.lower, 1e-14) << spelling(op);
    EXPECT_TRUE(exact_enclosure.total && exact_enclosure.bounded) << spelling(op);
    EXPECT_LE(exact(enclosure.lower), exact_enclosure.lower) << spelling(op);
    EXPECT_GE(exact(enclosure.upper), exact_enclosure.upper) << spelling(op);
  }
  for (auto op = Operator::add; op <= Operator::maximum; op = Operator(int(op) + 1)) {
    const double value = apply(op, 0.375, 1.25);
    const Interval enclosure = apply(op, Interval{0.375, 0.375}, Interval{1.25, 1.25});
    const RationalInterval exact_enclosure = apply(op, RationalInterval{q, q}, RationalInterval{r, r});
    EXPECT_TRUE(enclosure.contains(value)) << spelling(op);
    EXPECT_LT(enclosure.upper - enclosure.lower, 1e-14) << spelling(op);
    EXPECT_LE(exact(enclosure.lower), exact_enclosure.lower) << spelling(op);
    EXPECT_GE(exact(enclosure.upper), exact_enclosure.upper) << spelling(op);
  }
}

}  // namespace
}  // namespace coordreq

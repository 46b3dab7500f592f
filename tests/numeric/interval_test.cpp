#include "numeric/interval.hpp"

#include <gtest/gtest.h>

#include "numeric/random_doubles.hpp"

namespace coordreq {

std::ostream& operator<<(std::ostream& out, const Interval& a) {
  return out << '[' << a.lower << ", " << a.upper << "] " << (a.total ? "total" : "partial");
}
bool operator==(const Interval& a, const Interval& b) {
  return a.lower == b.lower && a.upper == b.upper && a.total == b.total;
}

namespace {

constexpr int kSamples = 100'000;
constexpr double kInf = outward::kInfinity;

Interval partial(double lower, double upper) {
  return {lower, upper, false};
}
bool encloses(const Interval& a, const Rational& q) {
  return (a.lower == -kInf || exact(a.lower) <= q) && (a.upper == kInf || exact(a.upper) >= q);
}
bool is_well_formed(const Interval& a) {
  return a.lower <= a.upper && a.lower < kInf && a.upper > -kInf;
}

TEST(Interval, ArithmeticEnclosesTheArithmeticOfPoints) {
  RandomDoubles random(10);
  for (int i = 0; i < kSamples; ++i) {
    const Interval a = random.interval();
    const Interval b = random.interval();
    const Rational x = exact(random.within(a));
    const Rational y = exact(random.within(b));
    for (const Interval& result : {a + b, a - b, a * b, a / b}) EXPECT_TRUE(is_well_formed(result));
    EXPECT_TRUE(encloses(a + b, x + y)) << a << b;
    EXPECT_TRUE(encloses(a - b, x - y)) << a << b;
    EXPECT_TRUE(encloses(a * b, x * y)) << a << b;
    EXPECT_TRUE(encloses(sqr(a), x * x)) << a;
    EXPECT_TRUE(encloses(abs(a), abs(x))) << a;
    EXPECT_TRUE(encloses(sign(a), sgn(x))) << a;
    EXPECT_TRUE(encloses(floor(a), floor(x))) << a;
    EXPECT_TRUE(encloses(min(a, b), x < y ? x : y)) << a << b;
    EXPECT_TRUE(encloses(max(a, b), x < y ? y : x)) << a << b;
    EXPECT_TRUE(encloses(hull(a, b), x) && encloses(hull(a, b), y)) << a << b;
    EXPECT_EQ((a / b).total, !b.contains(0.0)) << a << b;
    if (sgn(y) != 0) {
      EXPECT_TRUE(encloses(a / b, x / y)) << a << b;
    }
  }
}

TEST(Interval, ExactResultsStayPoints) {
  EXPECT_EQ((Interval{0.5, 0.5} + Interval{0.25, 0.25}), (Interval{0.75, 0.75}));
  EXPECT_EQ((Interval{3.0, 3.0} * Interval{-7.0, -7.0}), (Interval{-21.0, -21.0}));
  EXPECT_EQ((Interval{21.0, 21.0} / Interval{-8.0, -8.0}), (Interval{-2.625, -2.625}));
  EXPECT_EQ(sqrt(Interval{16.0, 25.0}), (Interval{4.0, 5.0}));
  EXPECT_EQ((Interval{-1.0, 2.0} - Interval{0.5, 1.5}), (Interval{-2.5, 1.5}));
}

TEST(Interval, InexactResultsAreOneStepWide) {
  const Interval third = Interval{1.0, 1.0} / Interval{3.0, 3.0};
  EXPECT_EQ(outward::next_up(third.lower), third.upper);
  const Interval sum = Interval{1.0, 1.0} + Interval{1e-30, 1e-30};
  EXPECT_EQ(sum, (Interval{1.0, outward::next_up(1.0)}));
}

TEST(Interval, ZeroTimesUnboundedIsZero) {
  EXPECT_EQ((Interval{0.0, 0.0} * whole_line(true)), (Interval{0.0, 0.0}));
  EXPECT_EQ((Interval{0.0, 1.0} * Interval{1.0, kInf}), (Interval{0.0, kInf}));
  EXPECT_EQ((Interval{-kInf, 0.0} * Interval{0.0, kInf}), (Interval{-kInf, 0.0}));
}

TEST(Interval, DivisorWithZeroGivesHalfLinesOrTheWholeLine) {
  const Interval positive{1.0, 2.0};
  const Interval negative{-2.0, -1.0};
  EXPECT_EQ((positive / Interval{0.0, 4.0}), partial(0.25, kInf));
  EXPECT_EQ((positive / Interval{-4.0, 0.0}), partial(-kInf, -0.25));
  EXPECT_EQ((negative / Interval{0.0, 4.0}), partial(-kInf, -0.25));
  EXPECT_EQ((negative / Interval{-4.0, 0.0}), partial(0.25, kInf));
  EXPECT_EQ((positive / Interval{-1.0, 4.0}), partial(-kInf, kInf));
  EXPECT_EQ((Interval{-1.0, 1.0} / Interval{0.0, 4.0}), partial(-kInf, kInf));
  EXPECT_EQ((positive / Interval{0.0, 0.0}), partial(-kInf, kInf));
  EXPECT_EQ((Interval{0.0, 0.0} / Interval{-1.0, 4.0}), partial(0.0, 0.0));
}

TEST(Interval, NotTotalIsCarriedOn) {
  const Interval a = partial(1.0, 2.0);
  const Interval b{3.0, 4.0};
  for (const Interval& result :
       {a + b,         b - a,     a * b,    b / a,   min(a, b),     max(b, a),
        sqr(a),        abs(a),    sign(a),  -a,      floor(a),      atan2(a, b),
        sqrt(a),       exp(a),    log(a),   sin(a),  cos(a),        tan(partial(0.1, 0.2)),
        atan(a),       sinh(a),   cosh(a),  tanh(a), power(a, 3.0), power(a, -3.0),
        power(a, 0.0), pow(b, a), pow(a, b)}) {
    EXPECT_FALSE(result.total) << result;
  }
}

TEST(Interval, RootsAndLogarithmsOutsideTheirDomainKeepThePartInside) {
  EXPECT_EQ(sqrt(Interval{-1.0, 4.0}), partial(0.0, 2.0));
  EXPECT_EQ(sqrt(Interval{-2.0, -1.0}), partial(-kInf, kInf));
  EXPECT_EQ(log(Interval{-1.0, 1.0}), partial(-kInf, 0.0));
  EXPECT_EQ(log(Interval{0.0, 1.0}), partial(-kInf, 0.0));
  EXPECT_EQ(log(Interval{-1.0, 0.0}), partial(-kInf, kInf));
  EXPECT_EQ(asin(Interval{2.0, 3.0}), partial(-kInf, kInf));
  EXPECT_EQ(acos(Interval{1.0, 3.0}), partial(0.0, 0.0));
  EXPECT_EQ(asin(Interval{0.0, 3.0}).lower, 0.0);
  EXPECT_FALSE(asin(Interval{0.0, 3.0}).total);
}

TEST(Interval, FunctionsAreExactWhereTheyAreRational) {
  const Interval zero{0.0, 0.0};
  const Interval one{1.0, 1.0};
  EXPECT_EQ(exp(zero), one);
  EXPECT_EQ(log(one), zero);
  EXPECT_EQ(cos(zero), one);
  EXPECT_EQ(cosh(zero), one);
  EXPECT_EQ(acos(one), zero);
  for (const Interval& result :
       {sin(zero), tan(zero), asin(zero), atan(zero), sinh(zero), tanh(zero), sqrt(zero)}) {
    EXPECT_EQ(result, zero);
  }
}

TEST(Interval, WavesReachTheirExtremaInside) {
  EXPECT_EQ(sin(Interval{1.0, 2.0}).upper, 1.0);
  EXPECT_GT(sin(Interval{1.0, 2.0}).lower, 0.84);
  EXPECT_EQ(sin(Interval{4.0, 5.0}).lower, -1.0);
  EXPECT_LT(sin(Interval{4.0, 5.0}).upper, -0.75);
  EXPECT_EQ(cos(Interval{-0.5, 0.5}).upper, 1.0);
  EXPECT_EQ(cos(Interval{3.0, 3.5}).lower, -1.0);
  EXPECT_LT(cos(Interval{3.0, 3.5}).upper, -0.93);
  EXPECT_EQ(sin(Interval{0.0, 7.0}), (Interval{-1.0, 1.0}));
  EXPECT_EQ(sin(Interval{1e300, 1.1e300}), (Interval{-1.0, 1.0}));
  EXPECT_EQ(cos(whole_line(true)), (Interval{-1.0, 1.0}));
}

TEST(Interval, TangentAcrossAPoleIsTheWholeLine) {
  EXPECT_EQ(tan(Interval{1.5, 1.6}), partial(-kInf, kInf));
  EXPECT_EQ(tan(Interval{-2.0, 2.0}), partial(-kInf, kInf));
  EXPECT_TRUE(tan(Interval{-1.5, 1.5}).total);
  EXPECT_TRUE(tan(Interval{1.6, 4.7}).total);
  const double below_pole = 1.5707963267948966;
  EXPECT_FALSE(tan(Interval{below_pole, outward::next_up(below_pole)}).total);
}

TEST(Interval, IntersectionOfDisjointIntervalsIsNothing) {
  EXPECT_FALSE(intersect(Interval{0.0, 1.0}, Interval{2.0, 3.0}).has_value());
  EXPECT_EQ(intersect(Interval{0.0, 2.0}, Interval{1.0, 3.0}).value(), (Interval{1.0, 2.0}));
  EXPECT_EQ(intersect(Interval{0.0, 1.0}, Interval{1.0, 3.0}).value(), (Interval{1.0, 1.0}));
}

TEST(Interval, RationalIsEnclosedByNeighbours) {
  const Interval tenth = enclose(Rational(1, 10));
  EXPECT_EQ(outward::next_up(tenth.lower), tenth.upper);
  EXPECT_TRUE(encloses(tenth, Rational(1, 10)));
  EXPECT_EQ(enclose(Rational(1, 8)), (Interval{0.125, 0.125}));
}

}  // namespace
}  // namespace coordreq

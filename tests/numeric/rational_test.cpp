#include "numeric/rational.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "numeric/random_doubles.hpp"

namespace coordreq {
namespace {

constexpr double kRationalInf = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

Rational decimal(std::string_view text) {
  return parse_decimal(text).value();
}

TEST(ParseDecimal, ReadsTheJsonNumberGrammarExactly) {
  EXPECT_EQ(decimal("0.1"), Rational(1, 10));
  EXPECT_EQ(decimal("-0.25"), Rational(-1, 4));
  EXPECT_EQ(decimal("12.50E+2"), 1250);
  EXPECT_EQ(decimal("1e-3"), Rational(1, 1000));
  EXPECT_EQ(decimal("0"), 0);
  EXPECT_EQ(decimal("-0.0"), 0);
  EXPECT_EQ(decimal(".5"), Rational(1, 2));
  EXPECT_EQ(decimal("5."), 5);
  EXPECT_EQ(decimal("5.e1"), 50);
  EXPECT_EQ(decimal("007"), 7);
}

TEST(ParseDecimal, RefusesEverythingElse) {
  for (const char* const text : {"", "-", ".", "e5", "1e", "1e+", "+1", "1 ", " 1", "0x10", "1.2.3", "nan",
                                 "inf", "1,5", "--1", "1e5.0"}) {
    EXPECT_FALSE(parse_decimal(text).has_value()) << text;
  }
}

TEST(ParseDecimal, GuardsAgainstHugeExponents) {
  EXPECT_TRUE(parse_decimal("1e5000").has_value());
  EXPECT_TRUE(parse_decimal("1e-5000").has_value());
  EXPECT_FALSE(parse_decimal("1e5001").has_value());
  EXPECT_FALSE(parse_decimal("1e99999999999999999999999").has_value());
  EXPECT_EQ(decimal("1e00000000000000000000003"), 1000);
}

TEST(NearestDouble, AgreesWithTheReadingOfDecimals) {
  for (const char* const text :
       {"0.1", "1e23", "9007199254740993", "2.2250738585072011e-308", "4.9e-324", "2.4703282292062327e-324",
        "2.4703282292062328e-324", "1.7976931348623157e308", "1.7976931348623158e308",
        "1.7976931348623159e308", "1e-400"}) {
    EXPECT_EQ(nearest_double(decimal(text)), std::strtod(text, nullptr)) << text;
    EXPECT_EQ(nearest_double(-decimal(text)), -std::strtod(text, nullptr)) << text;
  }
}

TEST(NearestDouble, TiesGoToEven) {
  const Rational half_step = Rational(exact(std::nextafter(1.0, 2.0)) - 1) / 2;
  EXPECT_EQ(nearest_double(1 + half_step), 1.0);
  EXPECT_EQ(nearest_double(1 + 3 * half_step), outward::moved(1.0, 2));
  EXPECT_EQ(nearest_double(exact(kLeast) / 2), 0.0);
  EXPECT_EQ(nearest_double(exact(kLeast) * 3 / 2), 2 * kLeast);
  EXPECT_EQ(nearest_double(Rational(mpz_class(1) << 1024) - Rational(mpz_class(1) << 970)), kRationalInf);
}

TEST(NearestDouble, OverflowsToInfinity) {
  EXPECT_EQ(nearest_double(decimal("1e309")), kRationalInf);
  EXPECT_EQ(nearest_double(decimal("-1e5000")), -kRationalInf);
  EXPECT_EQ(lower_double(decimal("1e309")), kLargest);
  EXPECT_EQ(upper_double(decimal("1e309")), kRationalInf);
  EXPECT_EQ(lower_double(decimal("-1e309")), -kRationalInf);
  EXPECT_EQ(upper_double(decimal("-1e309")), -kLargest);
}

TEST(NearestDouble, TinyValuesRoundAroundZero) {
  EXPECT_EQ(lower_double(decimal("1e-5000")), 0.0);
  EXPECT_EQ(upper_double(decimal("1e-5000")), kLeast);
  EXPECT_EQ(lower_double(decimal("-1e-5000")), -kLeast);
  EXPECT_EQ(upper_double(decimal("-1e-5000")), 0.0);
}

TEST(DoubleBounds, AreTheTightestOnes) {
  RandomDoubles random(40);
  for (int i = 0; i < 100'000; ++i) {
    const double a = random.any();
    EXPECT_EQ(nearest_double(exact(a)), a);
    EXPECT_EQ(lower_double(exact(a)), a);
    EXPECT_EQ(upper_double(exact(a)), a);
    const double b = outward::next_up(a);
    if (!std::isfinite(b)) continue;
    const Rational between = exact(a) + (exact(b) - exact(a)) * random.integer(1, 99) / Rational(100);
    EXPECT_EQ(lower_double(between), a);
    EXPECT_EQ(upper_double(between), b);
    const Rational middle = (exact(a) + exact(b)) / 2;
    if (between != middle) {
      EXPECT_EQ(nearest_double(between), between < middle ? a : b);
    }
  }
}

TEST(DoubleBounds, BracketEveryFraction) {
  EXPECT_TRUE(rc::check([](long n, long d) {
    RC_PRE(d != 0);
    const Rational q = Rational(n) / Rational(d);
    const double below = lower_double(q);
    const double above = upper_double(q);
    RC_ASSERT(exact(below) <= q && q <= exact(above));
    RC_ASSERT(below == above || outward::next_up(below) == above);
    RC_ASSERT(nearest_double(q) == below || nearest_double(q) == above);
  }));
}

TEST(IntegerRounding, RoundsDownAndUp) {
  EXPECT_EQ(floor_to_int(Rational(7, 2)), 3);
  EXPECT_EQ(ceil_to_int(Rational(7, 2)), 4);
  EXPECT_EQ(floor_to_int(Rational(-7, 2)), -4);
  EXPECT_EQ(ceil_to_int(Rational(-7, 2)), -3);
  EXPECT_EQ(floor_to_int(Rational(-3)), -3);
  EXPECT_EQ(ceil_to_int(Rational(-3)), -3);
}

TEST(IntegerRounding, Saturates) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 62;
  EXPECT_EQ(floor_to_int(decimal("1e30")), kLimit);
  EXPECT_EQ(ceil_to_int(decimal("-1e30")), -kLimit);
  EXPECT_EQ(floor_to_int(Rational(mpz_class(kLimit - 1))), kLimit - 1);
}

TEST(IntegerRounding, KnowsIntegers) {
  EXPECT_TRUE(is_integer(decimal("3.0")));
  EXPECT_TRUE(is_integer(0));
  EXPECT_FALSE(is_integer(Rational(1, 3)));
}

TEST(ToText, WritesWhatAUserWouldType) {
  EXPECT_EQ(to_text(Rational(-1, 4)), "-0.25");
  EXPECT_EQ(to_text(Rational(5, 2)), "2.5");
  EXPECT_EQ(to_text(Rational(1, 100)), "0.01");
  EXPECT_EQ(to_text(0), "0");
  EXPECT_EQ(to_text(-12), "-12");
  EXPECT_EQ(to_text(Rational(1, 3)), "1/3");
  EXPECT_EQ(to_text(Rational(-22, 7)), "-22/7");
}

TEST(ToText, LongDecimalsBecomeFractions) {
  EXPECT_EQ(to_text(decimal("0.12345678901234567")), "0.12345678901234567");
  EXPECT_EQ(to_text(decimal("1.12345678901234567")), "112345678901234567/100000000000000000");
  EXPECT_EQ(to_text(decimal("1e-18")), "1/1000000000000000000");
}

}  // namespace
}  // namespace coordreq

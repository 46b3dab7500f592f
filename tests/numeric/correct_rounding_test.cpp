#include "numeric/correct_rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numeric/big_value.hpp"
#include "numeric/random_doubles.hpp"

namespace coordreq {
namespace {

using F = ElementaryFunction;

TEST(CorrectRounding, AgreesWithMpfrOnDoubles) {
  const std::pair<F, BigValue::Unary> functions[] = {
      {F::sine, mpfr_sin},
      {F::cosine, mpfr_cos},
      {F::tangent, mpfr_tan},
      {F::arcsine, mpfr_asin},
      {F::arccosine, mpfr_acos},
      {F::arctangent, mpfr_atan},
      {F::hyperbolic_sine, mpfr_sinh},
      {F::hyperbolic_cosine, mpfr_cosh},
      {F::hyperbolic_tangent, mpfr_tanh},
      {F::exponential, mpfr_exp},
      {F::logarithm, mpfr_log},
      {F::square_root, mpfr_sqrt},
  };
  RandomDoubles random(50);
  BigValue value;
  for (int i = 0; i < 500; ++i) {
    const double x = random.any();
    for (const auto& [function, reference] : functions) {
      value.set(reference, x);
      const std::optional<double> nearest = nearest_value(function, exact(x));
      ASSERT_EQ(nearest.has_value(), value.is_defined()) << x;
      if (nearest) {
        ASSERT_EQ(*nearest, value.nearest()) << x;
      }
    }
  }
}

TEST(CorrectRounding, TakesArgumentsThatAreNoDoubles) {
  EXPECT_EQ(nearest_value(F::square_root, Rational(1, 9)), 1.0 / 3.0);
  EXPECT_EQ(nearest_value(F::sine, Rational(1, 3)), 0.32719469679615224418);
  EXPECT_EQ(nearest_value(F::cosine, Rational(1, 3)), 0.94495694631473766439);
  EXPECT_EQ(nearest_value(F::exponential, Rational(1, 3)), 1.39561242508608952863);
}

TEST(CorrectRounding, ResolvesExtremaAndPoles) {
  // The first 50 digits of pi/2: nearer to the maximum of sin than 128 bits of precision resolve.
  const Rational half_pi = parse_decimal("1.57079632679489661923132169163975144209858469968755").value();
  EXPECT_EQ(nearest_value(F::sine, half_pi), 1.0);
  EXPECT_LT(std::fabs(nearest_value(F::cosine, half_pi).value()), 1e-49);
  EXPECT_GT(std::fabs(nearest_value(F::tangent, half_pi).value()), 1e49);
}

TEST(CorrectRounding, HandlesHugeAndTinyArguments) {
  const Rational huge = parse_decimal("1e5000").value() + Rational(1, 3);
  EXPECT_LE(std::fabs(nearest_value(F::sine, huge).value()), 1.0);
  EXPECT_EQ(nearest_value(F::exponential, huge), std::numeric_limits<double>::infinity());
  EXPECT_EQ(nearest_value(F::exponential, -huge), 0.0);
  EXPECT_EQ(nearest_value(F::sine, 1 / huge), 0.0);
}

TEST(CorrectRounding, UndefinedIsNothing) {
  EXPECT_FALSE(nearest_value(F::logarithm, 0).has_value());
  EXPECT_FALSE(nearest_value(F::square_root, -1).has_value());
  EXPECT_FALSE(nearest_value(F::arcsine, Rational(3, 2)).has_value());
  EXPECT_FALSE(nearest_value(F::arccosine, Rational(-3, 2)).has_value());
}

TEST(CorrectRounding, Powers) {
  EXPECT_EQ(nearest_power(2, Rational(1, 2)), std::sqrt(2.0));
  EXPECT_EQ(nearest_power(2, Rational(1, 3)), 1.25992104989487316477);
  EXPECT_EQ(nearest_power(10, Rational(-1001, 2)), 0.0);
  EXPECT_EQ(nearest_power(10, Rational(1001, 2)), std::numeric_limits<double>::infinity());
}

TEST(CorrectRounding, Angles) {
  RandomDoubles random(51);
  BigValue value;
  for (int i = 0; i < 500; ++i) {
    const double y = random.any();
    const double x = random.any();
    if (y == 0.0 && x >= 0.0) continue;
    value.set(mpfr_atan2, y, x);
    ASSERT_EQ(nearest_angle(exact(y), exact(x)), value.nearest()) << y << ", " << x;
  }
  EXPECT_EQ(nearest_angle(0, -1), 3.14159265358979323846);
  EXPECT_EQ(nearest_angle(Rational(-1, 3), Rational(-1, 3)), -2.35619449019234492885);
  EXPECT_FALSE(nearest_angle(0, 0).has_value());
}

}  // namespace
}  // namespace coordreq

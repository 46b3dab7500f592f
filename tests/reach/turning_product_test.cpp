#include "reach/turning_product.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coordreq {
namespace {

std::vector<Interval> rotation(double angle, double uncertainty) {
  const auto around = [&](double x) { return Interval{x - uncertainty, x + uncertainty}; };
  return {around(std::cos(angle)), around(std::sin(angle)), around(-std::sin(angle)),
          around(std::cos(angle))};
}

TEST(TurningProduct, WidthsOfManyRotationsAddUp) {
  constexpr int kSteps = 200;
  constexpr double kAngle = 0.05;
  constexpr double kUncertainty = 1e-5;
  TurningProduct product(2);
  for (int k = 0; k < kSteps; ++k) product.append(rotation(kAngle, kUncertainty));
  const std::vector<Interval> exact = rotation(kSteps * kAngle, 0.0);
  for (std::size_t e = 0; e < 4; ++e) {
    const Interval entry = product.entry(e / 2, e % 2);
    EXPECT_TRUE(entry.contains(exact[e].lower));
    EXPECT_LE(entry.upper - entry.lower, 2.0 * kSteps * kUncertainty * 3.0);
  }
}

TEST(TurningProduct, HoldsProductsOfMatricesWithinTheFactors) {
  // Shears by different amounts commute: their product shears by the sum.
  TurningProduct product(2);
  for (int k = 0; k < 50; ++k) {
    product.append(std::vector<Interval>{{1.0, 1.0}, {0.1, 0.3}, {0.0, 0.0}, {1.0, 1.0}});
  }
  const Interval sheared = product.entry(0, 1);
  EXPECT_LE(sheared.lower, 5.0);
  EXPECT_GE(sheared.upper, 15.0);
  EXPECT_LE(sheared.upper - sheared.lower, 10.0 + 1e-9);
}

TEST(TurningProduct, SingularFactorsSayNothing) {
  TurningProduct product(2);
  product.append(std::vector<Interval>(4, Interval{0.0, 0.0}));
  EXPECT_TRUE(product.entry(0, 0).contains(0.0));
}

}  // namespace
}  // namespace coordreq

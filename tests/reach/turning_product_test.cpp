#include "reach/turning_product.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coordreq {
namespace {

IntervalMatrix rotation(double angle, double uncertainty) {
  const auto around = [&](double x) { return Interval{x - uncertainty, x + uncertainty}; };
  IntervalMatrix matrix(2, 2);
  matrix << around(std::cos(angle)), around(std::sin(angle)), around(-std::sin(angle)),
      around(std::cos(angle));
  return matrix;
}

TEST(TurningProduct, WidthsOfManyRotationsAddUp) {
  constexpr int kTurns = 200;
  constexpr double kAngle = 0.05;
  constexpr double kUncertainty = 1e-5;
  TurningProduct product(2);
  for (int k = 0; k < kTurns; ++k) product.append(to_upward(rotation(kAngle, kUncertainty)));
  const IntervalMatrix exact = rotation(kTurns * kAngle, 0.0);
  for (Eigen::Index e = 0; e < 4; ++e) {
    const Interval entry = product.enclosure()(e / 2, e % 2).interval();
    EXPECT_TRUE(entry.contains(exact(e / 2, e % 2).lower));
    EXPECT_LE(entry.upper - entry.lower, 2.0 * kTurns * kUncertainty * 3.0);
  }
}

TEST(TurningProduct, HoldsProductsOfMatricesWithinTheFactors) {
  // Shears by different amounts commute: their product shears by the sum.
  TurningProduct product(2);
  IntervalMatrix shear(2, 2);
  shear << Interval{1.0, 1.0}, Interval{0.1, 0.3}, Interval{0.0, 0.0}, Interval{1.0, 1.0};
  for (int k = 0; k < 50; ++k) product.append(to_upward(shear));
  const Interval sheared = product.enclosure()(0, 1).interval();
  EXPECT_LE(sheared.lower, 5.0);
  EXPECT_GE(sheared.upper, 15.0);
  EXPECT_LE(sheared.upper - sheared.lower, 10.0 + 1e-9);
}

TEST(TurningProduct, HoldsZeroAfterASingularFactor) {
  TurningProduct product(2);
  product.append(to_upward(IntervalMatrix::Constant(2, 2, Interval{0.0, 0.0})));
  EXPECT_TRUE(product.enclosure()(0, 0).contains_zero());
}

}  // namespace
}  // namespace coordreq

#include "reach/dormand_prince.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coordreq {
namespace {

using Values = DormandPrince::Values;

/// x' = x y, y' = 1 from (1, 0): x = exp(t^2 / 2).
DormandPrince one_step(double h) {
  DormandPrince pair(2);
  const auto field = [](const Values& x, Values& result) { result << x(0) * x(1), 1.0; };
  pair.step(field, Values{{1.0, 0.0}}, h);
  return pair;
}

double interpolation_error(const DormandPrince& pair, double h) {
  double worst = 0.0;
  Values x;
  for (double share = 0.05; share < 1.0; share += 0.05) {
    pair.interpolate(share, x);
    worst = std::max(worst, std::fabs(x(0) - std::exp(share * share * h * h / 2)));
    EXPECT_NEAR(x(1), share * h, 1e-15);
  }
  return worst;
}

TEST(DormandPrince, HasItsOrders) {
  // Halving a step divides the local error by 2^6, that of the interpolant by 2^5 at least.
  const double coarse = std::fabs(one_step(0.2).end()(0) - std::exp(0.02));
  const double fine = std::fabs(one_step(0.1).end()(0) - std::exp(0.005));
  EXPECT_GT(coarse / fine, 50.0);
  EXPECT_GT(interpolation_error(one_step(0.2), 0.2) / interpolation_error(one_step(0.1), 0.1), 25.0);
  EXPECT_GT(std::fabs(one_step(0.2).error()(0)), coarse);
}

TEST(DormandPrince, TheInterpolantMeetsBothEnds) {
  const DormandPrince pair = one_step(0.3);
  Values x;
  pair.interpolate(0.0, x);
  EXPECT_EQ(x, (Values{{1.0, 0.0}}));
  pair.interpolate(1.0, x);
  EXPECT_LT((x - pair.end()).norm(), 1e-15);
}

}  // namespace
}  // namespace coordreq

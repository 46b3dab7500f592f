#include "reach/stiff_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace coordreq {
namespace {

/// Both follow sin(t): x at once, y' = -rate (y - x).
Eigen::VectorXd follow(double rate, int* evaluations = nullptr) {
  const auto field = [&](const Eigen::VectorXd& x, Eigen::VectorXd& result) {
    if (evaluations != nullptr) ++*evaluations;
    result = Eigen::Vector3d(x(2), -rate * (x(1) - x(0)), -x(0));
  };
  const std::vector<double> scale(3, 0.1);
  StiffSolver solver(field, scale, 1e-12);
  solver.begin(Eigen::Vector3d(0.0, 1.0, 1.0));
  double left = 1.0;
  while (left > 0.0) {
    const double h = solver.step(left);
    if (h <= 0.0) break;
    left -= h;
  }
  Eigen::VectorXd end;
  solver.interpolate(1.0, end);
  return end;
}

TEST(StiffSolver, IsAccurateHoweverFastTheDecay) {
  for (const double rate : {1.0, 1e3, 1e6, 1e9}) {
    int evaluations = 0;
    const Eigen::VectorXd end = follow(rate, &evaluations);
    EXPECT_NEAR(end(0), std::sin(1.0), 1e-9);
    // y follows rate (rate sin - cos)/(1 + rate^2), but for what has decayed.
    const double particular = rate * (rate * std::sin(1.0) - std::cos(1.0)) / (1 + rate * rate);
    const double rest = (1.0 + rate / (1 + rate * rate)) * std::exp(-rate);
    EXPECT_NEAR(end(1), particular + rest, 1e-9);
    EXPECT_LT(evaluations, 20000);
  }
}

TEST(StiffSolver, InterpolatesItsLastStep) {
  const auto field = [](const Eigen::VectorXd& x, Eigen::VectorXd& result) { result = -x; };
  const std::vector<double> scale{1.0};
  StiffSolver solver(field, scale, 1e-10);
  solver.begin(Eigen::VectorXd::Constant(1, 1.0));
  double time = 0.0;
  while (time < 0.5) {
    const double h = solver.step(1.0 - time);
    ASSERT_GT(h, 0.0);
    Eigen::VectorXd x;
    for (const double share : {0.0, 0.3, 1.0}) {
      solver.interpolate(share, x);
      EXPECT_NEAR(x(0), std::exp(-(time + share * h)), 1e-8);
    }
    time += h;
  }
}

TEST(StiffSolver, SaysWhereThereIsNoNextState) {
  const auto field = [](const Eigen::VectorXd& x, Eigen::VectorXd& result) { result = x.array().square(); };
  const std::vector<double> scale{1.0};
  StiffSolver solver(field, scale, 1e-10);
  solver.begin(Eigen::VectorXd::Constant(1, 1.0));  // 1/(1 - t)
  double time = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double h = solver.step(2.0 - time);
    if (h <= 0.0) break;
    time += h;
  }
  EXPECT_LT(time, 1.0001);
}

}  // namespace
}  // namespace coordreq

#include "reach/sensitivity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "reach/matrix_exponential.hpp"
#include "reach/random_flow.hpp"

namespace coordreq {
namespace {

Interval point(double value) {
  return Interval(value);
}

TEST(TransitionMatrix, OfARotation) {
  const IntervalMatrix rotation{{point(0.0), point(-1.0)}, {point(1.0), point(0.0)}};
  TransitionMatrix matrix(2, TransitionMatrix::kManyTerms);
  ASSERT_TRUE(matrix.enclose(rotation, point(2.0), {false, false}));
  EXPECT_NEAR(matrix.end()(0, 0).lower(), std::cos(2.0), 1e-14);
  EXPECT_NEAR(matrix.end()(0, 0).upper(), std::cos(2.0), 1e-14);
  EXPECT_NEAR(matrix.end()(0, 1).lower(), -std::sin(2.0), 1e-14);
  EXPECT_NEAR(matrix.end()(0, 1).upper(), -std::sin(2.0), 1e-14);
}

TEST(TransitionMatrix, SignsOfAMonotoneSystemAreProved) {
  // Off-diagonal entries of one sign but of unknown size; far along the chain only the tail is left.
  constexpr Eigen::Index n = 8;
  IntervalMatrix chain(n, n);
  chain.diagonal().setConstant({-3.0, 1.0});
  chain.diagonal<1>().setConstant({0.0, 2.0});
  chain(0, 1) = {-2.0, 0.0};
  TransitionMatrix matrix(n, TransitionMatrix::kFewTerms);
  ASSERT_TRUE(matrix.enclose(chain, point(0.1), std::vector<bool>(n)));
  EXPECT_GT(matrix.end()(0, 0).lower(), 0.0);
  EXPECT_LE(matrix.end()(0, n - 1).upper(), 0.0);
  EXPECT_LT(matrix.end()(0, n - 1).lower(), 0.0);
  EXPECT_GE(matrix.end()(1, n - 1).lower(), 0.0);
  EXPECT_EQ(matrix.end()(1, 0).lower(), 0.0);
  EXPECT_EQ(matrix.end()(1, 0).upper(), 0.0);
}

TEST(TransitionMatrix, LoopsOnTheWayCanTurnTheSign) {
  // 0 -> 2 -> 3 with a rotation of 1 and 2 by three radians.
  const Matrix a{{-3, 0, 1, 0}, {0, 0, 2, 0}, {0, -2, 0, 1}, {0, 0, 0, -3}};
  IntervalMatrix jacobian(4, 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      jacobian(i, j) =
          point(static_cast<double>(a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]));
    }
  }
  TransitionMatrix matrix(4, TransitionMatrix::kManyTerms);
  ASSERT_TRUE(matrix.enclose(jacobian, point(1.5), std::vector<bool>(4)));
  const double exact = static_cast<double>(exponential(a, 1.5L)[0][3]);
  EXPECT_LT(exact, 0.0);
  EXPECT_NEAR(matrix.end()(0, 3).lower(), exact, 1e-13);
  EXPECT_NEAR(matrix.end()(0, 3).upper(), exact, 1e-13);
}

TEST(TransitionMatrix, UnboundedDecayDoesNoHarm) {
  const IntervalMatrix decay{{Interval(-outward::kInfinity, -1.0), point(1.0)}, {point(0.0), point(0.0)}};
  TransitionMatrix matrix(2, TransitionMatrix::kFewTerms);
  ASSERT_TRUE(matrix.enclose(decay, point(0.5), {true, false}));
  EXPECT_GE(matrix.end()(0, 0).lower(), 0.0);
  EXPECT_LE(matrix.end()(0, 1).upper(), 0.51);
  EXPECT_FALSE(matrix.enclose(decay, point(0.5), {false, false}));
}

TEST(TransitionMatrix, TooLongADurationIsRefused) {
  TransitionMatrix matrix(1, TransitionMatrix::kFewTerms);
  EXPECT_FALSE(matrix.enclose(IntervalMatrix::Constant(1, 1, {-1e6, 1e6}), point(1.0), {false}));
}

struct RandomSystem {
  std::size_t n;
  IntervalMatrix jacobian;
  std::vector<bool> damped;
  long double duration;
};

RandomSystem random_system() {
  RandomSystem result;
  result.n = static_cast<std::size_t>(1 + pick(4));
  result.jacobian.resize(static_cast<Eigen::Index>(result.n), static_cast<Eigen::Index>(result.n));
  for (Eigen::Index e = 0; e < result.jacobian.size(); ++e) {
    const double lower = pick(3) == 0 ? 0.0 : pick_between(-2.0, 2.0);
    result.jacobian.data()[e] = {lower, lower + (pick(2) == 0 ? 0.0 : pick_between(0.0, 1.0))};
  }
  for (std::size_t i = 0; i < result.n; ++i) result.damped.push_back(pick(3) == 0);
  result.duration = pick_between(0.05, 1.0);
  return result;
}

/// exp of a matrix within the bounds, with some damping.
Matrix random_piece(const RandomSystem& system, long double duration) {
  Matrix a(system.n, Vector(system.n));
  for (std::size_t i = 0; i < system.n; ++i) {
    for (std::size_t j = 0; j < system.n; ++j) {
      const Interval& range = system.jacobian.data()[i * system.n + j];
      a[i][j] = pick_between(range.lower, range.upper, 3);
    }
    if (system.damped[i]) a[i][i] -= 20.0 * pick(4);
  }
  return exponential(a, duration);
}

TEST(TransitionMatrix, HoldsThoseOfEveryTimeVaryingSystem) {
  EXPECT_TRUE(rc::check([] {
    for (int k = 0; k < 10; ++k) {
      const RandomSystem system = random_system();
      const double h = static_cast<double>(system.duration);
      TransitionMatrix matrix(system.n, TransitionMatrix::kFewTerms);
      if (!matrix.enclose(system.jacobian, point(h), system.damped)) continue;
      const int pieces = 1 + pick(5);
      const long double piece = system.duration / pieces;
      Matrix phi(system.n, Vector(system.n));
      for (std::size_t i = 0; i < system.n; ++i) phi[i][i] = 1.0L;
      // Backwards from the end: Phi(h, s) for smaller and smaller s.
      for (int p = 0; p < pieces; ++p) {
        phi = product(phi, random_piece(system, piece));
        for (std::size_t e = 0; e < system.n * system.n; ++e) {
          const long double value = phi[e / system.n][e % system.n];
          const Interval range = matrix.range().data()[e].interval();
          RC_ASSERT(range.lower - 1e-16L <= value && value <= range.upper + 1e-16L);
        }
      }
      for (std::size_t e = 0; e < system.n * system.n; ++e) {
        const long double value = phi[e / system.n][e % system.n];
        const Interval end = matrix.end().data()[e].interval();
        RC_ASSERT(end.lower - 1e-16L <= value && value <= end.upper + 1e-16L);
      }
    }
  }));
}

TEST(TransitionMatrix, BoundsTheIntegralOfItsMagnitude) {
  EXPECT_TRUE(rc::check([] {
    const RandomSystem system = random_system();
    TransitionMatrix matrix(system.n, TransitionMatrix::kFewTerms);
    if (!matrix.enclose(system.jacobian, point(static_cast<double>(system.duration)), system.damped)) return;
    // One constant system; the midpoint rule from 0 to h.
    constexpr int kPieces = 400;
    Matrix a(system.n, Vector(system.n));
    for (std::size_t e = 0; e < system.n * system.n; ++e) {
      a[e / system.n][e % system.n] =
          pick_between(system.jacobian.data()[e].lower, system.jacobian.data()[e].upper, 3);
    }
    const Matrix step = exponential(a, system.duration / kPieces);
    Matrix phi = exponential(a, system.duration / (2 * kPieces));
    Matrix sum(system.n, Vector(system.n));
    for (int p = 0; p < kPieces; ++p) {
      for (std::size_t i = 0; i < system.n; ++i) {
        for (std::size_t j = 0; j < system.n; ++j) {
          sum[i][j] += std::fabs(phi[i][j]) * system.duration / kPieces;
        }
      }
      phi = product(phi, step);
    }
    for (std::size_t e = 0; e < system.n * system.n; ++e) {
      RC_ASSERT(sum[e / system.n][e % system.n] <= matrix.integral().data()[e] * (1.0L + 1e-4L));
    }
  }));
}

}  // namespace
}  // namespace coordreq

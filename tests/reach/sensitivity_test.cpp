#include "reach/sensitivity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "reach/matrix_exponential.hpp"
#include "reach/random_flow.hpp"

namespace coordreq {
namespace {

using Intervals = std::vector<Interval>;

Interval point(double value) {
  return {value, value};
}

TEST(TransitionMatrix, OfARotation) {
  const Intervals rotation{point(0.0), point(-1.0), point(1.0), point(0.0)};
  TransitionMatrix matrix(2, TransitionMatrix::kManyTerms);
  ASSERT_TRUE(matrix.enclose(rotation, point(2.0), {false, false}));
  EXPECT_NEAR(matrix.end()[0].lower, std::cos(2.0), 1e-14);
  EXPECT_NEAR(matrix.end()[0].upper, std::cos(2.0), 1e-14);
  EXPECT_NEAR(matrix.end()[1].lower, -std::sin(2.0), 1e-14);
  EXPECT_NEAR(matrix.end()[1].upper, -std::sin(2.0), 1e-14);
}

TEST(TransitionMatrix, SignsOfAMonotoneSystemAreProved) {
  // Off-diagonal entries of one sign but of unknown size; far along the chain only the tail is left.
  const std::size_t n = 8;
  Intervals chain(n * n, point(0.0));
  for (std::size_t i = 0; i < n; ++i) chain[i * n + i] = {-3.0, 1.0};
  for (std::size_t i = 0; i + 1 < n; ++i) chain[i * n + i + 1] = {i == 0 ? -2.0 : 0.0, i == 0 ? 0.0 : 2.0};
  TransitionMatrix matrix(n, TransitionMatrix::kFewTerms);
  ASSERT_TRUE(matrix.enclose(chain, point(0.1), std::vector<bool>(n)));
  EXPECT_GT(matrix.end()[0].lower, 0.0);
  EXPECT_LE(matrix.end()[n - 1].upper, 0.0);
  EXPECT_LT(matrix.end()[n - 1].lower, 0.0);
  EXPECT_GE(matrix.end()[2 * n - 1].lower, 0.0);
  EXPECT_EQ(matrix.end()[n].lower, 0.0);
  EXPECT_EQ(matrix.end()[n].upper, 0.0);
}

TEST(TransitionMatrix, LoopsOnTheWayCanTurnTheSign) {
  // 0 -> 2 -> 3 with a rotation of 1 and 2 by three radians.
  const Matrix a{{-3, 0, 1, 0}, {0, 0, 2, 0}, {0, -2, 0, 1}, {0, 0, 0, -3}};
  Intervals jacobian;
  for (const Vector& row : a) {
    for (const long double entry : row) jacobian.push_back(point(static_cast<double>(entry)));
  }
  TransitionMatrix matrix(4, TransitionMatrix::kManyTerms);
  ASSERT_TRUE(matrix.enclose(jacobian, point(1.5), std::vector<bool>(4)));
  const double exact = static_cast<double>(exponential(a, 1.5L)[0][3]);
  EXPECT_LT(exact, 0.0);
  EXPECT_NEAR(matrix.end()[3].lower, exact, 1e-13);
  EXPECT_NEAR(matrix.end()[3].upper, exact, 1e-13);
}

TEST(TransitionMatrix, UnboundedDecayDoesNoHarm) {
  const Intervals decay{{-outward::kInfinity, -1.0}, point(1.0), point(0.0), point(0.0)};
  TransitionMatrix matrix(2, TransitionMatrix::kFewTerms);
  ASSERT_TRUE(matrix.enclose(decay, point(0.5), {true, false}));
  EXPECT_GE(matrix.end()[0].lower, 0.0);
  EXPECT_LE(matrix.end()[1].upper, 0.51);
  EXPECT_FALSE(matrix.enclose(decay, point(0.5), {false, false}));
}

TEST(TransitionMatrix, TooLongADurationIsRefused) {
  TransitionMatrix matrix(1, TransitionMatrix::kFewTerms);
  EXPECT_FALSE(matrix.enclose(Intervals{{-1e6, 1e6}}, point(1.0), {false}));
}

struct RandomSystem {
  std::size_t n;
  Intervals jacobian;
  std::vector<bool> damped;
  long double duration;
};

RandomSystem random_system() {
  RandomSystem result;
  result.n = static_cast<std::size_t>(1 + pick(4));
  for (std::size_t i = 0; i < result.n * result.n; ++i) {
    const double lower = pick(3) == 0 ? 0.0 : pick_between(-2.0, 2.0);
    result.jacobian.push_back({lower, lower + (pick(2) == 0 ? 0.0 : pick_between(0.0, 1.0))});
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
      const Interval& range = system.jacobian[i * system.n + j];
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
          const Interval& range = matrix.range()[e];
          RC_ASSERT(range.lower - 1e-16L <= value && value <= range.upper + 1e-16L);
        }
      }
      for (std::size_t e = 0; e < system.n * system.n; ++e) {
        const long double value = phi[e / system.n][e % system.n];
        const Interval& end = matrix.end()[e];
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
      a[e / system.n][e % system.n] = pick_between(system.jacobian[e].lower, system.jacobian[e].upper, 3);
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
      RC_ASSERT(sum[e / system.n][e % system.n] <= matrix.integral()[e] * (1.0L + 1e-4L));
    }
  }));
}

}  // namespace
}  // namespace coordreq

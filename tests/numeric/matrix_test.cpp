#include "numeric/matrix.hpp"

#include <gtest/gtest.h>

#include "numeric/random_doubles.hpp"

namespace coordreq {
namespace {

bool same(const Interval& a, const Interval& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

/// The product as the textbook has it.
Interval sum_of_products(const IntervalMatrix& a, const IntervalMatrix& b, Eigen::Index i, Eigen::Index j) {
  Interval sum;
  for (Eigen::Index k = 0; k < a.cols(); ++k) sum = sum + a(i, k) * b(k, j);
  return sum;
}

IntervalMatrix random_matrix(RandomDoubles& random, Eigen::Index rows, Eigen::Index columns) {
  IntervalMatrix matrix(rows, columns);
  for (Interval& entry : matrix.reshaped()) {
    if (random.integer(0, 2) != 0) entry = random.interval();
  }
  return matrix;
}

TEST(Matrix, EntriesBeginAtZeroAndOnesArePoints) {
  EXPECT_TRUE(IntervalMatrix(2, 3).unaryExpr([](const Interval& a) { return a.is_zero(); }).all());
  const IntervalMatrix one = IntervalMatrix::Identity(2, 2);
  EXPECT_TRUE(same(one(0, 0), Interval(1.0)));
  EXPECT_TRUE(same(one(0, 1), Interval(0.0)));
}

TEST(Matrix, ProductsAreSummedInOrder) {
  // Large enough for Eigen to cut its own products into blocks; sums of doubles of any size show the order.
  RandomDoubles random(1);
  for (const Eigen::Index n : {1, 2, 3, 7, 8, 9, 16, 33, 70}) {
    const IntervalMatrix a = random_matrix(random, n, n);
    const IntervalMatrix b = random_matrix(random, n, n);
    const IntervalMatrix c = product(a, b);
    const IntervalVector column = product(a, b.col(n - 1));
    const IntervalRow row = product(a.row(0), b);
    for (Eigen::Index i = 0; i < n; ++i) {
      ASSERT_TRUE(same(column(i), sum_of_products(a, b, i, n - 1)));
      ASSERT_TRUE(same(row(i), sum_of_products(a, b, 0, i)));
      for (Eigen::Index j = 0; j < n; ++j) {
        ASSERT_TRUE(same(c(i, j), sum_of_products(a, b, i, j))) << n << ' ' << i << ' ' << j;
      }
    }
  }
}

TEST(Matrix, ZerosStayZeros) {
  // Block triangular matrices of any numbers: no rounding outward, and no infinity, fills the empty block.
  RandomDoubles random(2);
  for (int run = 0; run < 200; ++run) {
    const Eigen::Index n = random.integer(2, 24);
    const Eigen::Index cut = random.integer(1, static_cast<int>(n) - 1);
    IntervalMatrix a = random_matrix(random, n, n);
    IntervalMatrix b = random_matrix(random, n, n);
    a.bottomLeftCorner(n - cut, cut).setZero();
    b.bottomLeftCorner(n - cut, cut).setZero();
    IntervalMatrix c = product(a, b);
    for (int power = 0; power < 3; ++power) {
      c += b;
      c = product(c, a).eval();
      c *= Interval(-0x1p-600, 0x1p-600);
    }
    for (const Interval& entry : c.bottomLeftCorner(n - cut, cut).reshaped()) ASSERT_TRUE(entry.is_zero());
  }
}

TEST(Matrix, ProductsHoldThoseOfPoints) {
  RandomDoubles random(3);
  for (int run = 0; run < 300; ++run) {
    const Eigen::Index n = random.integer(1, 6);
    const IntervalMatrix a = random_matrix(random, n, n);
    const IntervalMatrix b = random_matrix(random, n, n);
    const IntervalMatrix c = product(a, b);
    const auto point_of = [&](const Interval& entry) { return exact(random.within(entry)); };
    RationalMatrix x(n, n);
    RationalMatrix y(n, n);
    for (Eigen::Index e = 0; e < n * n; ++e) x.data()[e] = point_of(a.data()[e]);
    for (Eigen::Index e = 0; e < n * n; ++e) y.data()[e] = point_of(b.data()[e]);
    const RationalMatrix z = product(x, y);
    for (Eigen::Index e = 0; e < n * n; ++e) {
      const Interval& entry = c.data()[e];
      ASSERT_TRUE(!std::isfinite(entry.lower) || exact(entry.lower) <= z.data()[e]);
      ASSERT_TRUE(!std::isfinite(entry.upper) || exact(entry.upper) >= z.data()[e]);
    }
  }
}

TEST(Matrix, OfRationalsIsExact) {
  RationalMatrix a(2, 2);
  a << Rational(1, 3), Rational(1, 7), Rational(0), Rational(-2, 5);
  const RationalMatrix square = product(a, a);
  EXPECT_EQ(square(0, 0), Rational(1, 9));
  EXPECT_EQ(square(0, 1), Rational(-1, 105));
  EXPECT_EQ(square(1, 0), 0);
  EXPECT_EQ(square(1, 1), Rational(4, 25));
  EXPECT_EQ(RationalMatrix::Identity(2, 2)(1, 1), 1);
}

}  // namespace
}  // namespace coordreq

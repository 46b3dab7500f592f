#pragma once

#include <Eigen/Core>

#include "numeric/interval.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

inline Interval& operator+=(Interval& a, const Interval& b) {
  return a = a + b;
}
inline Interval& operator-=(Interval& a, const Interval& b) {
  return a = a - b;
}
inline Interval& operator*=(Interval& a, const Interval& b) {
  return a = a * b;
}
inline Interval& operator/=(Interval& a, const Interval& b) {
  return a = a / b;
}

}  // namespace coordreq

/// The traits that Eigen needs of a scalar.
template <>
struct Eigen::NumTraits<coordreq::Interval> : Eigen::GenericNumTraits<coordreq::Interval> {
  enum { RequireInitialization = 1, ReadCost = 3, AddCost = 10, MulCost = 30 };
};
template <>
struct Eigen::NumTraits<coordreq::Rational> : Eigen::GenericNumTraits<coordreq::Rational> {
  enum { RequireInitialization = 1, ReadCost = 10, AddCost = 100, MulCost = 100 };
};

namespace coordreq {

template <class Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
template <class Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using RowOf = Eigen::Matrix<Scalar, 1, Eigen::Dynamic>;

using IntervalMatrix = MatrixOf<Interval>;
using IntervalVector = VectorOf<Interval>;
using IntervalRow = RowOf<Interval>;
using RationalMatrix = MatrixOf<Rational>;
using RationalVector = VectorOf<Rational>;
using RationalRow = RowOf<Rational>;
using RealMatrix = MatrixOf<double>;
using RealVector = VectorOf<double>;

/// a b, every entry summed one product after the other in the order of the columns of `a`. Eigen's own
/// product sums large matrices in blocks, and the ends of intervals depend on the order. An entry that is a
/// sum of zeros is exactly zero.
///
/// Not evaluated before it is assigned. @pre unchecked: both outlive it, and neither is what it is assigned
/// to
template <class A, class B>
[[nodiscard]] auto product(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.lazyProduct(b);
}

/// The largest magnitudes of the entries of an interval matrix.
template <class A>
[[nodiscard]] auto magnitudes(const Eigen::MatrixBase<A>& a) {
  return a.unaryExpr([](const Interval& entry) { return entry.magnitude(); });
}

template <class A>
[[nodiscard]] bool is_finite(const Eigen::MatrixBase<A>& a) {
  return a.unaryExpr([](const Interval& entry) { return entry.is_finite(); }).all();
}

}  // namespace coordreq

#pragma once

#include "base/requires.hpp"
#include "numeric/matrix.hpp"
#include "numeric/upward_interval.hpp"

template <>
struct Eigen::NumTraits<coordreq::UpwardInterval> : Eigen::GenericNumTraits<coordreq::UpwardInterval> {
  enum { RequireInitialization = 1, ReadCost = 2, AddCost = 1, MulCost = 12 };
};

namespace coordreq {

using UpwardMatrix = MatrixOf<UpwardInterval>;
using RealRow = RowOf<double>;

/// c := a b, each entry summed as product() does. Within rounded_upward(). @pre c has its size and is neither
template <class A, class B>
void multiply(const A& a, const B& b, UpwardMatrix& c) {
  REQUIRES(c.rows() == a.rows() && c.cols() == b.cols());
  for (Eigen::Index i = 0; i < c.rows(); ++i) {
    for (Eigen::Index j = 0; j < c.cols(); ++j) {
      UpwardInterval sum = a(i, 0) * b(0, j);
      for (Eigen::Index k = 1; k < a.cols(); ++k) sum += a(i, k) * b(k, j);
      c(i, j) = sum;
    }
  }
}

[[nodiscard]] inline bool is_finite(const UpwardMatrix& a) {
  return a.unaryExpr([](const UpwardInterval& entry) { return entry.is_finite(); }).all();
}

[[nodiscard]] inline UpwardMatrix to_upward(const IntervalMatrix& a) {
  return a.unaryExpr([](const Interval& entry) { return UpwardInterval(entry); });
}
[[nodiscard]] inline IntervalMatrix to_intervals(const UpwardMatrix& a) {
  return a.unaryExpr([](const UpwardInterval& entry) { return entry.interval(); });
}

}  // namespace coordreq

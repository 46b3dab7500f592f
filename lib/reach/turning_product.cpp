#include "reach/turning_product.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "numeric/outward.hpp"

namespace coordreq {
namespace {

IntervalMatrix points(const RealMatrix& a) {
  return a.unaryExpr([](double x) { return Interval{x, x}; });
}

RealMatrix middles(const IntervalMatrix& a) {
  return a.unaryExpr([](const Interval& x) { return x.lower + (x.upper - x.lower) / 2; });
}

}  // namespace

TurningProduct::TurningProduct(Eigen::Index dimension)
    : middle_(dimension, dimension), frame_(dimension, dimension), rest_(dimension, dimension) {
  reset();
}

void TurningProduct::reset() {
  lost_ = false;
  middle_.setIdentity();
  frame_.setIdentity();
  rest_.setConstant(Interval{0.0, 0.0});
}

/// T (C + Q R) = C' + Q' (Q'^-1 (T C - C') + (Q'^-1 T Q) R).
void TurningProduct::append(const IntervalMatrix& factor) {
  if (lost_) return;
  const RealMatrix about = middles(factor);
  const RealMatrix middle = about * middle_;
  const RealMatrix frame = orthogonal(about * frame_);
  const IntervalMatrix back = inverse(frame);
  if (lost_) return;
  const IntervalMatrix moved = product(factor, points(middle_));
  const IntervalMatrix error = moved - points(middle);
  const IntervalMatrix turned = product(factor, points(frame_));
  const IntervalMatrix turn = product(back, turned);
  const IntervalMatrix old = product(turn, rest_);
  const IntervalMatrix now = product(back, error);
  rest_ = now + old;
  middle_ = middle;
  frame_ = frame;
}

Interval TurningProduct::entry(Eigen::Index i, Eigen::Index j) const {
  if (lost_) return whole_line(true);
  Interval sum{middle_(i, j), middle_(i, j)};
  for (Eigen::Index k = 0; k < rest_.rows(); ++k)
    sum = sum + Interval{frame_(i, k), frame_(i, k)} * rest_(k, j);
  return sum;
}

/// An orthogonal basis of the columns, beginning with those along which the rest is widest.
RealMatrix TurningProduct::orthogonal(const RealMatrix& columns) const {
  const RealVector reach =
      magnitudes(rest_).rowwise().sum().cwiseProduct(columns.colwise().norm().transpose());
  // Widths that have overflowed cannot be ordered.
  const RealVector widths = reach.unaryExpr([](double x) { return std::isfinite(x) ? x : HUGE_VAL; });
  std::vector<Eigen::Index> order(static_cast<std::size_t>(columns.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return widths(a) > widths(b); });
  RealMatrix sorted(columns.rows(), columns.cols());
  for (std::size_t k = 0; k < order.size(); ++k)
    sorted.col(static_cast<Eigen::Index>(k)) = columns.col(order[k]);
  return Eigen::HouseholderQR<RealMatrix>(sorted).householderQ();
}

/// (I - E)^-1 Q^T with E = I - Q^T Q, whose norm is e: no entry is farther from Q^T than e / (1 - e) times
/// the largest of Q, and e / (1 - e) <= 2 e where e <= 1/2.
IntervalMatrix TurningProduct::inverse(const RealMatrix& orthogonal) {
  lost_ = !orthogonal.allFinite();
  if (lost_) return {};
  const IntervalMatrix transposed = points(orthogonal.transpose());
  const IntervalMatrix square = product(transposed, points(orthogonal));
  double norm = 0.0;
  for (Eigen::Index i = 0; i < square.rows(); ++i) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < square.cols(); ++j) {
      const double unit = i == j ? 1.0 : 0.0;
      sum = outward::add_up(sum, (square(i, j) - Interval{unit, unit}).magnitude());
    }
    norm = std::max(norm, sum);
  }
  lost_ = !(norm < 0.5);
  const double largest = orthogonal.cwiseAbs().maxCoeff();
  // In the norm of rows an entry of (sum of E^k) Q^T is at most the norm times the largest of Q.
  const double error = outward::multiply_up(outward::multiply_up(2.0, norm), largest);
  return transposed.unaryExpr([error](const Interval& x) { return x + Interval{-error, error}; });
}

}  // namespace coordreq

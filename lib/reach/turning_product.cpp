#include "reach/turning_product.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coordreq {
namespace {

double middle_of(const UpwardInterval& x) {
  return x.lower() + (x.upper() - x.lower()) / 2;
}

}  // namespace

TurningProduct::TurningProduct(Eigen::Index dimension)
    : middle_(dimension, dimension),
      frame_(dimension, dimension),
      rest_(dimension, dimension),
      enclosure_(dimension, dimension),
      about_(dimension, dimension),
      next_middle_(dimension, dimension),
      next_frame_(dimension, dimension),
      columns_(dimension, dimension),
      sorted_(dimension, dimension),
      widths_(dimension),
      workspace_(dimension),
      order_(static_cast<std::size_t>(dimension)),
      decomposition_(dimension, dimension),
      back_(dimension, dimension),
      turned_(dimension, dimension),
      turn_(dimension, dimension),
      error_(dimension, dimension),
      next_rest_(dimension, dimension) {
  reset();
}

void TurningProduct::reset() {
  lost_ = false;
  middle_.setIdentity();
  frame_.setIdentity();
  rest_.setZero();
  enclosure_.setIdentity();
}

/// T (C + Q R) = C' + Q' (Q'^-1 (T C - C') + (Q'^-1 T Q) R).
void TurningProduct::append(const UpwardMatrix& factor) {
  if (lost_) return;
  for (Eigen::Index e = 0; e < factor.size(); ++e) about_.data()[e] = middle_of(factor.data()[e]);
  next_middle_.noalias() = about_ * middle_;
  columns_.noalias() = about_ * frame_;
  find_frame();
  lost_ = !next_frame_.allFinite();
  if (!lost_) rounded_upward([this] { find_inverse(); });
  if (lost_) {
    enclosure_.setConstant(UpwardInterval(whole_line(true)));
    return;
  }
  rounded_upward([&] {
    turn(factor);
    multiply_out();
  });
}

void TurningProduct::turn(const UpwardMatrix& factor) {
  multiply(factor, middle_, error_);
  for (Eigen::Index e = 0; e < error_.size(); ++e)
    error_.data()[e] += UpwardInterval(-next_middle_.data()[e]);
  multiply(factor, frame_, turned_);
  multiply(back_, turned_, turn_);
  multiply(turn_, rest_, turned_);
  multiply(back_, error_, next_rest_);
  for (Eigen::Index e = 0; e < rest_.size(); ++e) rest_.data()[e] = next_rest_.data()[e] + turned_.data()[e];
  middle_.swap(next_middle_);
  frame_.swap(next_frame_);
}

void TurningProduct::multiply_out() {
  for (Eigen::Index i = 0; i < rest_.rows(); ++i) {
    for (Eigen::Index j = 0; j < rest_.cols(); ++j) {
      UpwardInterval sum(middle_(i, j));
      for (Eigen::Index k = 0; k < rest_.rows(); ++k) sum += rest_(k, j) * frame_(i, k);
      enclosure_(i, j) = sum;
    }
  }
}

/// An orthogonal basis of the columns, beginning with those along which the rest is widest.
void TurningProduct::find_frame() {
  widths_ = columns_.colwise().norm();
  for (Eigen::Index j = 0; j < columns_.cols(); ++j) {
    double reach = 0.0;
    for (Eigen::Index k = 0; k < rest_.cols(); ++k) reach += rest_(j, k).magnitude();
    widths_(j) *= reach;
    // Widths that have overflowed cannot be ordered.
    if (!std::isfinite(widths_(j))) widths_(j) = HUGE_VAL;
  }
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  std::sort(order_.begin(), order_.end(),
            [&](Eigen::Index a, Eigen::Index b) { return widths_(a) > widths_(b); });
  for (std::size_t k = 0; k < order_.size(); ++k)
    sorted_.col(static_cast<Eigen::Index>(k)) = columns_.col(order_[k]);
  decomposition_.compute(sorted_);
  decomposition_.householderQ().evalTo(next_frame_, workspace_);
}

/// (I - E)^-1 Q^T with E = I - Q^T Q, whose norm is e: no entry is farther from Q^T than e / (1 - e) times
/// the largest of Q, and e / (1 - e) <= 2 e where e <= 1/2.
void TurningProduct::find_inverse() {
  double norm = 0.0;
  for (Eigen::Index i = 0; i < next_frame_.cols(); ++i) {
    double row = 0.0;
    for (Eigen::Index j = 0; j < next_frame_.cols(); ++j) {
      UpwardInterval entry(i == j ? -1.0 : 0.0);
      UpwardInterval sum = UpwardInterval(next_frame_(0, i)) * next_frame_(0, j);
      for (Eigen::Index k = 1; k < next_frame_.rows(); ++k)
        sum += UpwardInterval(next_frame_(k, i)) * next_frame_(k, j);
      entry += sum;
      row += entry.magnitude();
    }
    norm = std::max(norm, row);
  }
  lost_ = !(norm < 0.5);
  // In the norm of rows an entry of (sum of E^k) Q^T is at most the norm times the largest of Q.
  const double error = 2.0 * norm * next_frame_.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < back_.rows(); ++i) {
    for (Eigen::Index j = 0; j < back_.cols(); ++j)
      back_(i, j) = UpwardInterval(next_frame_(j, i)) + UpwardInterval(-error, error);
  }
}

}  // namespace coordreq

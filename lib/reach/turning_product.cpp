#include "reach/turning_product.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reach/dual.hpp"

namespace coordreq {
namespace {

std::vector<Interval> points(const std::vector<double>& a) {
  std::vector<Interval> result;
  for (const double x : a) result.push_back({x, x});
  return result;
}

double magnitude(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper));
}

}  // namespace

TurningProduct::TurningProduct(std::size_t dimension) : n_(dimension) {
  reset();
}

void TurningProduct::reset() {
  lost_ = false;
  middle_.assign(n_ * n_, 0.0);
  for (std::size_t i = 0; i < n_; ++i) middle_[i * n_ + i] = 1.0;
  frame_ = middle_;
  rest_.assign(n_ * n_, Interval{});
}

/// T (C + Q R) = C' + Q' (Q'^-1 (T C - C') + (Q'^-1 T Q) R).
void TurningProduct::append(std::span<const Interval> factor) {
  if (lost_) return;
  const Numbers middle = middle_times(factor, middle_);
  const Numbers frame = orthogonal(middle_times(factor, frame_));
  const Intervals back = inverse(frame);
  if (lost_) return;
  Intervals error = times(factor, points(middle_));
  for (std::size_t e = 0; e < error.size(); ++e) error[e] = error[e] - Interval{middle[e], middle[e]};
  error = times(back, error);
  const Intervals turned = times(times(back, times(factor, points(frame_))), rest_);
  for (std::size_t e = 0; e < error.size(); ++e) rest_[e] = error[e] + turned[e];
  middle_ = middle;
  frame_ = frame;
}

Interval TurningProduct::entry(std::size_t i, std::size_t j) const {
  if (lost_) return whole_line(true);
  Interval sum{middle_[i * n_ + j], middle_[i * n_ + j]};
  for (std::size_t k = 0; k < n_; ++k) {
    sum = sum + Interval{frame_[i * n_ + k], frame_[i * n_ + k]} * rest_[k * n_ + j];
  }
  return sum;
}

TurningProduct::Intervals TurningProduct::times(std::span<const Interval> a,
                                                std::span<const Interval> b) const {
  Intervals result(n_ * n_);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t k = 0; k < n_; ++k) {
      for (std::size_t j = 0; j < n_; ++j) {
        result[i * n_ + j] = result[i * n_ + j] + a[i * n_ + k] * b[k * n_ + j];
      }
    }
  }
  return result;
}

TurningProduct::Numbers TurningProduct::middle_times(std::span<const Interval> factor,
                                                     const Numbers& b) const {
  Numbers result(n_ * n_);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t k = 0; k < n_; ++k) {
      const double middle = midpoint(factor[i * n_ + k]);
      for (std::size_t j = 0; j < n_; ++j) result[i * n_ + j] += middle * b[k * n_ + j];
    }
  }
  return result;
}

/// Makes columns orthogonal, beginning with those along which the rest is widest.
TurningProduct::Numbers TurningProduct::orthogonal(Numbers columns) const {
  std::vector<double> reach(n_);
  for (std::size_t k = 0; k < n_; ++k) {
    for (std::size_t j = 0; j < n_; ++j) reach[k] += magnitude(rest_[k * n_ + j]);
    double length = 0.0;
    for (std::size_t i = 0; i < n_; ++i) length = std::hypot(length, columns[i * n_ + k]);
    reach[k] *= length;
  }
  std::vector<std::size_t> order(n_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return reach[a] > reach[b]; });
  for (std::size_t m = 0; m < n_; ++m) {
    const std::size_t k = order[m];
    double length = 0.0;
    // Twice is enough for rounding errors of what is left after the first time.
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t p = 0; p < m; ++p) {
        double along = 0.0;
        for (std::size_t i = 0; i < n_; ++i) along += columns[i * n_ + order[p]] * columns[i * n_ + k];
        for (std::size_t i = 0; i < n_; ++i) columns[i * n_ + k] -= along * columns[i * n_ + order[p]];
      }
      length = 0.0;
      for (std::size_t i = 0; i < n_; ++i) length = std::hypot(length, columns[i * n_ + k]);
      for (std::size_t i = 0; i < n_; ++i) columns[i * n_ + k] /= length;
    }
  }
  return columns;
}

/// (I - E)^-1 Q^T with E = I - Q^T Q, whose norm is e: no entry is farther from Q^T than e / (1 - e) times
/// the largest of Q.
TurningProduct::Intervals TurningProduct::inverse(const Numbers& orthogonal) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  lost_ = !std::all_of(orthogonal.begin(), orthogonal.end(), is_finite);
  if (lost_) return {};
  Intervals transposed(n_ * n_);
  double largest = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j < n_; ++j) {
      const double entry = orthogonal[j * n_ + i];
      transposed[i * n_ + j] = {entry, entry};
      largest = std::max(largest, std::fabs(entry));
    }
  }
  double norm = 0.0;
  const Intervals product = times(transposed, points(orthogonal));
  for (std::size_t i = 0; i < n_; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n_; ++j) {
      const Interval unit = i == j ? Interval{1.0, 1.0} : Interval{};
      sum = outward::add_up(sum, magnitude(product[i * n_ + j] - unit));
    }
    norm = std::max(norm, sum);
  }
  lost_ = norm >= 0.5;
  const double error = outward::multiply_up(outward::multiply_up(2.0, norm), largest);
  for (Interval& entry : transposed) entry = entry + Interval{-error, error};
  return transposed;
}

}  // namespace coordreq

#include "reach/flow_sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using outward::add_up;
using outward::multiply_up;

double magnitude(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper));
}

bool is_zero(const Interval& a) {
  return a.lower == 0.0 && a.upper == 0.0;
}

double product_up(double a, double b) {
  return a == 0.0 || b == 0.0 ? 0.0 : multiply_up(a, b);
}

}  // namespace

Interval scalar_product(std::span<const Interval> row, std::span<const Interval> matrix, std::size_t column,
                        std::size_t columns) {
  Interval sum{0.0, 0.0};
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Interval& entry = matrix[k * columns + column];
    if (!is_zero(row[k]) && !is_zero(entry)) sum = sum + row[k] * entry;
  }
  return sum;
}

FlowSensitivity::FlowSensitivity(std::size_t states, std::size_t disturbances)
    : n_(states),
      m_(disturbances),
      initial_(states * states),
      turning_(states),
      kernel_(states * disturbances),
      weight_(states * disturbances),
      jump_(states),
      next_(states * std::max(states, disturbances)),
      next_size_(states * std::max<std::size_t>(disturbances, 1)) {}

void FlowSensitivity::reset() {
  bounded_ = true;
  first_ = true;
  turning_.reset();
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    const double entry = i % (n_ + 1) == 0 ? 1.0 : 0.0;
    initial_[i] = {entry, entry};
  }
  std::fill(kernel_.begin(), kernel_.end(), Interval{0.0, 0.0});
  std::fill(weight_.begin(), weight_.end(), 0.0);
  std::fill(jump_.begin(), jump_.end(), 0.0);
}

void FlowSensitivity::append(const TransitionMatrix& transition, const Jacobian& jacobian) {
  append_kernel(transition, jacobian);
  append_sizes(transition, jacobian);
  append_initial(transition);
  first_ = false;
}

void FlowSensitivity::lose() {
  bounded_ = false;
  first_ = false;
}

void FlowSensitivity::append_initial(const TransitionMatrix& transition) {
  turning_.append(transition.end());
  if (first_) {
    std::copy(transition.end().begin(), transition.end().end(), initial_.begin());
    return;
  }
  for (std::size_t i = 0; i < n_; ++i) {
    const auto row = transition.end().subspan(i * n_, n_);
    for (std::size_t j = 0; j < n_; ++j) next_[i * n_ + j] = scalar_product(row, initial_, j, n_);
    for (std::size_t j = 0; j < n_; ++j) {
      Interval& entry = next_[i * n_ + j];
      entry = intersect(entry, turning_.entry(i, j)).value_or(entry);
    }
  }
  std::copy_n(next_.begin(), n_ * n_, initial_.begin());
}

/// What acted before is carried on by Phi(h, 0), what acts in this step by Phi(h, s).
void FlowSensitivity::append_kernel(const TransitionMatrix& transition, const Jacobian& jacobian) {
  for (std::size_t i = 0; i < n_; ++i) {
    const auto end = transition.end().subspan(i * n_, n_);
    const auto range = transition.range().subspan(i * n_, n_);
    for (std::size_t l = 0; l < m_; ++l) {
      const Interval now = scalar_product(range, jacobian.disturbance(), l, m_);
      next_[i * m_ + l] = first_ ? now : hull(now, scalar_product(end, kernel_, l, m_));
    }
  }
  std::copy_n(next_.begin(), n_ * m_, kernel_.begin());
}

void FlowSensitivity::append_sizes(const TransitionMatrix& transition, const Jacobian& jacobian) {
  const auto carried = [&](std::size_t i, std::size_t k, double before, double acting) {
    const double old = product_up(magnitude(transition.end()[i * n_ + k]), before);
    return add_up(old, product_up(transition.integral()[i * n_ + k], acting));
  };
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t l = 0; l < m_; ++l) {
      double sum = 0.0;
      for (std::size_t k = 0; k < n_; ++k) {
        sum = add_up(sum, carried(i, k, weight_[k * m_ + l], magnitude(jacobian.disturbance()[k * m_ + l])));
      }
      next_size_[i * m_ + l] = sum;
    }
  }
  std::copy_n(next_size_.begin(), n_ * m_, weight_.begin());
  for (std::size_t i = 0; i < n_; ++i) {
    next_size_[i] = 0.0;
    for (std::size_t k = 0; k < n_; ++k) {
      next_size_[i] = add_up(next_size_[i], carried(i, k, jump_[k], jacobian.jump()[k]));
    }
  }
  std::copy_n(next_size_.begin(), n_, jump_.begin());
}

}  // namespace coordreq

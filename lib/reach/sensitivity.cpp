#include "reach/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using outward::add_up;
using outward::divide_up;
using outward::kInfinity;
using outward::multiply_up;

constexpr Interval kZero{0.0, 0.0};
constexpr Interval kOne{1.0, 1.0};
constexpr Interval kUnit{0.0, 1.0};

constexpr std::size_t kMostTerms = 80;
constexpr double kMoreDiagonal = 0.5;
constexpr double kNegligible = 1e-19;
/// More than what underflow can take away.
constexpr double kTiny = 0x1p-1000;
/// The diagonal entry of a damped state times the duration is at least minus this.
constexpr double kStrongestDecay = 4.0;

constexpr unsigned kPositive = 1U;
constexpr unsigned kNegative = 2U;
constexpr unsigned kBoth = kPositive | kNegative;

/// The signs that products of numbers with signs `a` and `b` can have.
unsigned times(unsigned a, unsigned b) {
  if (a == 0U || b == 0U) return 0U;
  if (a == kBoth || b == kBoth) return kBoth;
  return a == b ? kPositive : kNegative;
}

double magnitude(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper));
}

bool is_zero(const Interval& a) {
  return a.lower == 0.0 && a.upper == 0.0;
}

bool is_bounded(const Interval& a) {
  return a.lower >= -outward::kLargest && a.upper <= outward::kLargest;
}

Interval with_zero(const Interval& a) {
  return {std::min(a.lower, 0.0), std::max(a.upper, 0.0)};
}

double number(std::size_t value) {
  return static_cast<double>(value);
}

}  // namespace

TransitionMatrix::TransitionMatrix(std::size_t dimension, std::size_t interval_terms)
    : n_(dimension),
      interval_terms_(interval_terms),
      shifted_(dimension * dimension),
      term_(dimension * dimension),
      product_(dimension * dimension),
      magnitude_(dimension * dimension),
      size_(dimension * dimension),
      next_size_(dimension * dimension),
      signs_(dimension * dimension),
      end_(dimension * dimension),
      range_(dimension * dimension),
      integral_(dimension * dimension) {}

bool TransitionMatrix::enclose(std::span<const Interval> jacobian, const Interval& duration,
                               const std::vector<bool>& damped) {
  if (!shift(jacobian, duration.upper, damped)) return false;
  find_signs();
  start(damped);
  std::size_t k = 1;
  for (; k <= interval_terms_ && !is_negligible(); ++k) {
    next_magnitude(k, duration.upper);
    add_term(k, duration, damped);
  }
  if (!add_tail(k, duration.upper)) return false;
  apply_signs();
  apply_shift(duration);
  return std::all_of(end_.begin(), end_.end(), is_bounded);
}

bool TransitionMatrix::shift(std::span<const Interval> jacobian, double duration,
                             const std::vector<bool>& damped) {
  double alpha = -kInfinity;
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    shifted_[i] = jacobian[i];
    if (i % (n_ + 1) != 0) continue;
    // Damping makes up for a diagonal entry that is taken too large, and a moderate one keeps alpha small.
    if (damped[i / n_]) {
      const double diagonal = std::max(jacobian[i].upper, -kStrongestDecay / duration);
      shifted_[i] = {diagonal, diagonal};
    }
    alpha = std::max(alpha, -shifted_[i].lower);
  }
  if (!std::all_of(shifted_.begin(), shifted_.end(), is_bounded)) return false;
  alpha_ = {alpha, alpha};
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    if (i % (n_ + 1) == 0) shifted_[i] = max(shifted_[i] + alpha_, kZero);
    magnitude_[i] = magnitude(shifted_[i]);
  }
  return true;
}

/// Signs of the products along all walks from i to j (Kleene's algorithm). Damping changes no sign.
void TransitionMatrix::find_signs() {
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    signs_[i] = (shifted_[i].upper > 0.0 ? kPositive : 0U) | (shifted_[i].lower < 0.0 ? kNegative : 0U);
  }
  for (std::size_t k = 0; k < n_; ++k) {
    const unsigned loops = signs_[k * n_ + k] | kPositive;
    for (std::size_t i = 0; i < n_; ++i) {
      const unsigned to = times(signs_[i * n_ + k], (loops & kNegative) != 0U ? kBoth : kPositive);
      for (std::size_t j = 0; j < n_; ++j) signs_[i * n_ + j] |= times(to, signs_[k * n_ + j]);
    }
  }
  for (std::size_t i = 0; i < n_; ++i) signs_[i * n_ + i] |= kPositive;
}

void TransitionMatrix::apply_signs() {
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    for (Interval* entry : {&end_[i], &range_[i]}) {
      if ((signs_[i] & kNegative) == 0U) *entry = max(*entry, kZero);
      if ((signs_[i] & kPositive) == 0U) *entry = min(*entry, kZero);
    }
  }
}

void TransitionMatrix::start(const std::vector<bool>& damped) {
  std::fill(term_.begin(), term_.end(), kZero);
  std::fill(size_.begin(), size_.end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    term_[i * n_ + i] = damped[i] ? kUnit : kOne;
    size_[i * n_ + i] = 1.0;
  }
  end_ = term_;
  range_ = term_;
  integral_ = size_;
}

/// term := term (A + alpha I) D h / k.
void TransitionMatrix::add_term(std::size_t k, const Interval& duration, const std::vector<bool>& damped) {
  const Interval factor = k == 1 ? duration : duration / Interval{number(k), number(k)};
  std::fill(product_.begin(), product_.end(), kZero);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t l = 0; l < n_; ++l) {
      if (is_zero(term_[i * n_ + l])) continue;
      const Interval scaled = term_[i * n_ + l] * factor;
      for (std::size_t j = 0; j < n_; ++j) {
        const Interval& entry = shifted_[l * n_ + j];
        if (!is_zero(entry)) product_[i * n_ + j] = product_[i * n_ + j] + scaled * entry;
      }
    }
  }
  term_.swap(product_);
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    if (is_zero(term_[i])) continue;
    if (damped[i % n_]) term_[i] = with_zero(term_[i]);
    end_[i] = end_[i] + term_[i];
    range_[i] = range_[i] + with_zero(term_[i]);
  }
}

/// size := size |A + alpha I| h / k, and its part of the integral.
/// @returns whether no entry is more than half of what it was
bool TransitionMatrix::next_magnitude(std::size_t k, double duration) {
  const double factor = divide_up(duration, number(k));
  // Sums of non-negative numbers: one factor covers all roundings.
  const double slack = 1.0 + 0x1p-50 * number(n_ + 4);
  bool halved = true;
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j < n_; ++j) {
      double sum = 0.0;
      bool any = false;
      for (std::size_t l = 0; l < n_; ++l) {
        const double left = size_[i * n_ + l];
        const double right = magnitude_[l * n_ + j];
        any = any || (left > 0.0 && right > 0.0);
        sum += left * right;
      }
      next_size_[i * n_ + j] = any ? sum * factor * slack + kTiny : 0.0;
      halved = halved && next_size_[i * n_ + j] <= 0.5 * size_[i * n_ + j];
    }
  }
  size_.swap(next_size_);
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    if (size_[i] > 0.0) integral_[i] = add_up(integral_[i], divide_up(size_[i], number(k + 1)));
  }
  return halved;
}

/// Whether the last term is below the rounding errors of the sum.
bool TransitionMatrix::is_negligible() const {
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    if (size_[i] > kNegligible * integral_[i]) return false;
  }
  return true;
}

/// Adds all terms beyond the interval terms: once a term is at most half of the one before in every entry, so
/// are all that follow, and their sum is at most that term. A larger diagonal keeps entries from coming and
/// going in turns, as in a rotation, which that test could not stand.
bool TransitionMatrix::add_tail(std::size_t k, double duration) {
  const double more = divide_up(kMoreDiagonal, duration);
  for (std::size_t i = 0; i < n_; ++i) magnitude_[i * (n_ + 1)] = add_up(magnitude_[i * (n_ + 1)], more);
  for (; k <= kMostTerms; ++k) {
    const bool halved = next_magnitude(k, duration);
    for (std::size_t i = 0; i < n_ * n_; ++i) {
      if (size_[i] == 0.0) continue;
      const double rest = halved ? multiply_up(2.0, size_[i]) : size_[i];
      const Interval tail{-rest, rest};
      end_[i] = end_[i] + tail;
      range_[i] = range_[i] + tail;
      if (halved) integral_[i] = add_up(integral_[i], size_[i]);
    }
    if (halved) return true;
    if (!std::all_of(size_.begin(), size_.end(), [](double x) { return x <= outward::kLargest; })) break;
  }
  return false;
}

/// Multiplies by exp(-alpha s). Its integral against s^k is at most the product of both averages and h where
/// one falls and the other rises (Chebyshev).
void TransitionMatrix::apply_shift(const Interval& duration) {
  const Interval decay = exp(-(alpha_ * duration));
  const Interval on_the_way = hull(kOne, decay);
  double average = on_the_way.upper;
  if (alpha_.lower > 0.0) {
    const Interval exact_average = (kOne - decay) / (alpha_ * duration);
    average = std::min(average, exact_average.upper);
  }
  const double weight = multiply_up(average, duration.upper);
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    if (!is_zero(end_[i])) end_[i] = end_[i] * decay;
    if (!is_zero(range_[i])) range_[i] = range_[i] * on_the_way;
    if (integral_[i] > 0.0) integral_[i] = multiply_up(integral_[i], weight);
  }
}

}  // namespace coordreq

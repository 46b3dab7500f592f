#include "reach/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using outward::add_up;
using outward::divide_up;
using outward::kInfinity;
using outward::multiply_up;

constexpr Interval kNone{0.0, 0.0};
constexpr Interval kOne{1.0, 1.0};
constexpr Interval kUnit{0.0, 1.0};

constexpr std::size_t kMostPowers = 80;
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

Interval with_zero(const Interval& a) {
  return {std::min(a.lower, 0.0), std::max(a.upper, 0.0)};
}

double number(std::size_t value) {
  return static_cast<double>(value);
}

}  // namespace

TransitionMatrix::TransitionMatrix(std::size_t dimension, std::size_t interval_terms)
    : n_(static_cast<Eigen::Index>(dimension)),
      interval_terms_(interval_terms),
      shifted_(n_, n_),
      term_(n_, n_),
      scaled_(n_, n_),
      magnitude_(n_, n_),
      size_(n_, n_),
      next_size_(n_, n_),
      signs_(n_, n_),
      end_(n_, n_),
      range_(n_, n_),
      integral_(n_, n_) {}

bool TransitionMatrix::enclose(const IntervalMatrix& jacobian, const Interval& duration,
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
  apply_signs(end_);
  apply_signs(range_);
  apply_shift(duration);
  return is_finite(end_);
}

bool TransitionMatrix::shift(const IntervalMatrix& jacobian, double duration,
                             const std::vector<bool>& damped) {
  shifted_ = jacobian;
  double alpha = -kInfinity;
  for (Eigen::Index i = 0; i < n_; ++i) {
    Interval& diagonal = shifted_(i, i);
    // Damping makes up for a diagonal entry that is taken too large, and a moderate one keeps alpha small.
    if (damped[static_cast<std::size_t>(i)]) {
      diagonal = Interval(std::max(diagonal.upper, -kStrongestDecay / duration));
    }
    alpha = std::max(alpha, -diagonal.lower);
  }
  if (!is_finite(shifted_)) return false;
  alpha_ = Interval(alpha);
  for (Interval& diagonal : shifted_.diagonal()) diagonal = max(diagonal + alpha_, kNone);
  magnitude_ = magnitudes(shifted_);
  return true;
}

/// Signs of the products along all walks from i to j (Kleene's algorithm). Damping changes no sign.
void TransitionMatrix::find_signs() {
  signs_ = shifted_.unaryExpr(
      [](const Interval& a) { return (a.upper > 0.0 ? kPositive : 0U) | (a.lower < 0.0 ? kNegative : 0U); });
  for (Eigen::Index k = 0; k < n_; ++k) {
    const unsigned loops = (signs_(k, k) & kNegative) != 0U ? kBoth : kPositive;
    for (Eigen::Index i = 0; i < n_; ++i) {
      const unsigned to = times(signs_(i, k), loops);
      for (Eigen::Index j = 0; j < n_; ++j) signs_(i, j) |= times(to, signs_(k, j));
    }
  }
  for (unsigned& sign : signs_.diagonal()) sign |= kPositive;
}

void TransitionMatrix::apply_signs(IntervalMatrix& matrix) const {
  for (Eigen::Index e = 0; e < matrix.size(); ++e) {
    Interval& entry = matrix.data()[e];
    if ((signs_.data()[e] & kNegative) == 0U) entry = max(entry, kNone);
    if ((signs_.data()[e] & kPositive) == 0U) entry = min(entry, kNone);
  }
}

void TransitionMatrix::start(const std::vector<bool>& damped) {
  term_.setIdentity();
  for (Eigen::Index i = 0; i < n_; ++i) {
    if (damped[static_cast<std::size_t>(i)]) term_(i, i) = kUnit;
  }
  size_.setIdentity();
  end_ = term_;
  range_ = term_;
  integral_ = size_;
}

/// term := term (A + alpha I) D h / k.
void TransitionMatrix::add_term(std::size_t k, const Interval& duration, const std::vector<bool>& damped) {
  scaled_ = term_ * (k == 1 ? duration : duration / Interval(number(k)));
  term_.noalias() = product(scaled_, shifted_);
  for (Eigen::Index j = 0; j < n_; ++j) {
    if (damped[static_cast<std::size_t>(j)]) term_.col(j) = term_.col(j).unaryExpr(&with_zero);
  }
  end_ += term_;
  range_ += term_.unaryExpr(&with_zero);
}

/// size := size |A + alpha I| h / k, and its part of the integral.
/// @returns whether no entry is more than half of what it was
bool TransitionMatrix::next_magnitude(std::size_t k, double duration) {
  // Sums of non-negative numbers: one factor covers all roundings, one summand what underflows.
  const double slack = 1.0 + 0x1p-50 * static_cast<double>(n_ + 4);
  const double factor = divide_up(duration, number(k));
  for (Eigen::Index i = 0; i < n_; ++i) {
    for (Eigen::Index j = 0; j < n_; ++j) {
      const auto left = size_.row(i).transpose().array();
      const auto right = magnitude_.col(j).array();
      const bool any = (left > 0.0 && right > 0.0).any();
      next_size_(i, j) = any ? (left * right).sum() * factor * slack + kTiny : 0.0;
    }
  }
  const bool halved = (next_size_.array() <= 0.5 * size_.array()).all();
  size_.swap(next_size_);
  integral_ = integral_.binaryExpr(size_, [&](double sum, double size) {
    return size > 0.0 ? add_up(sum, divide_up(size, number(k + 1))) : sum;
  });
  return halved;
}

/// Whether the last term is below the rounding errors of the sum.
bool TransitionMatrix::is_negligible() const {
  return (size_.array() <= kNegligible * integral_.array()).all();
}

/// Adds all terms beyond the interval terms: once a term is at most half of the one before in every entry, so
/// are all that follow, and their sum is at most that term. A larger diagonal keeps entries from coming and
/// going in turns, as in a rotation, which that test could not stand.
bool TransitionMatrix::add_tail(std::size_t k, double duration) {
  const double more = divide_up(kMoreDiagonal, duration);
  for (double& diagonal : magnitude_.diagonal()) diagonal = add_up(diagonal, more);
  for (bool halved = false; !halved; ++k) {
    if (k > kMostPowers) return false;
    halved = next_magnitude(k, duration);
    const auto tail = size_.unaryExpr([halved](double size) {
      const double rest = halved ? multiply_up(2.0, size) : size;
      return Interval(-rest, rest);
    });
    end_ += tail;
    range_ += tail;
    if (!(size_.array() <= outward::kLargest).all()) return false;
    if (halved) integral_ = integral_.binaryExpr(size_, &add_up);
  }
  return true;
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
  end_ *= decay;
  range_ *= on_the_way;
  integral_ = integral_.unaryExpr([&](double sum) { return multiply_up(sum, weight); });
}

}  // namespace coordreq

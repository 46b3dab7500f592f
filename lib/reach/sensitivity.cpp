#include "reach/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using outward::divide_up;
using outward::kInfinity;

constexpr Interval kOne{1.0, 1.0};

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
    rounded_upward([&] {
      integrate_magnitude(k);
      add_term(k, UpwardInterval(duration), damped);
    });
  }
  if (!add_tail(k, duration.upper)) return false;
  apply_signs(end_);
  apply_signs(range_);
  apply_shift(duration);
  return is_finite(end_);
}

bool TransitionMatrix::shift(const IntervalMatrix& jacobian, double duration,
                             const std::vector<bool>& damped) {
  alpha_ = -kInfinity;
  bool finite = true;
  for (Eigen::Index i = 0; i < n_; ++i) {
    for (Eigen::Index j = 0; j < n_; ++j) shifted_(i, j) = UpwardInterval(jacobian(i, j));
    UpwardInterval& diagonal = shifted_(i, i);
    // Damping makes up for a diagonal entry that is taken too large, and a moderate one keeps alpha small.
    if (damped[static_cast<std::size_t>(i)]) {
      diagonal = UpwardInterval(std::max(diagonal.upper(), -kStrongestDecay / duration));
    }
    alpha_ = std::max(alpha_, -diagonal.lower());
    for (Eigen::Index j = 0; j < n_; ++j) finite = finite && shifted_(i, j).is_finite();
  }
  if (!finite) return false;
  rounded_upward([this] {
    for (UpwardInterval& diagonal : shifted_.diagonal())
      diagonal = positive_part(diagonal + UpwardInterval(alpha_));
  });
  for (Eigen::Index e = 0; e < shifted_.size(); ++e) magnitude_.data()[e] = shifted_.data()[e].magnitude();
  return true;
}

/// Signs of the products along all walks from i to j (Kleene's algorithm). Damping changes no sign.
void TransitionMatrix::find_signs() {
  signs_ = shifted_.unaryExpr([](const UpwardInterval& a) {
    return (a.upper() > 0.0 ? kPositive : 0U) | (a.lower() < 0.0 ? kNegative : 0U);
  });
  for (Eigen::Index k = 0; k < n_; ++k) {
    const unsigned loops = (signs_(k, k) & kNegative) != 0U ? kBoth : kPositive;
    for (Eigen::Index i = 0; i < n_; ++i) {
      const unsigned to = times(signs_(i, k), loops);
      for (Eigen::Index j = 0; j < n_; ++j) signs_(i, j) |= times(to, signs_(k, j));
    }
  }
  for (unsigned& sign : signs_.diagonal()) sign |= kPositive;
}

void TransitionMatrix::apply_signs(UpwardMatrix& matrix) const {
  for (Eigen::Index e = 0; e < matrix.size(); ++e) {
    UpwardInterval& entry = matrix.data()[e];
    if ((signs_.data()[e] & kNegative) == 0U) entry = positive_part(entry);
    if ((signs_.data()[e] & kPositive) == 0U) entry = negative_part(entry);
  }
}

void TransitionMatrix::start(const std::vector<bool>& damped) {
  term_.setZero();
  for (Eigen::Index i = 0; i < n_; ++i) {
    term_(i, i) = UpwardInterval(damped[static_cast<std::size_t>(i)] ? 0.0 : 1.0, 1.0);
  }
  size_.setIdentity();
  end_ = term_;
  range_ = term_;
  integral_ = size_;
}

/// term := term (A + alpha I) D h / k.
void TransitionMatrix::add_term(std::size_t k, const UpwardInterval& duration,
                                const std::vector<bool>& damped) {
  const UpwardInterval factor = k == 1 ? duration : duration / UpwardInterval(number(k));
  for (Eigen::Index e = 0; e < term_.size(); ++e) scaled_.data()[e] = term_.data()[e] * factor;
  multiply(scaled_, shifted_, term_);
  for (Eigen::Index i = 0; i < n_; ++i) {
    for (Eigen::Index j = 0; j < n_; ++j) {
      UpwardInterval& entry = term_(i, j);
      const UpwardInterval during = hull_with_zero(entry);
      if (damped[static_cast<std::size_t>(j)]) entry = during;
      end_(i, j) += entry;
      range_(i, j) += during;
    }
  }
}

/// size := size |A + alpha I| h / k.
/// @returns whether no entry is more than half of what it was
bool TransitionMatrix::next_magnitude(std::size_t k, double duration) {
  // Sums of non-negative numbers: one factor covers all roundings, one summand what underflows.
  const double slack = 1.0 + 0x1p-50 * static_cast<double>(n_ + 4);
  const double factor = divide_up(duration, number(k));
  for (Eigen::Index i = 0; i < n_; ++i) {
    for (Eigen::Index j = 0; j < n_; ++j) {
      bool any = false;
      double sum = 0.0;
      for (Eigen::Index m = 0; m < n_; ++m) {
        any = any || (size_(i, m) > 0.0 && magnitude_(m, j) > 0.0);
        sum += size_(i, m) * magnitude_(m, j);
      }
      next_size_(i, j) = any ? sum * factor * slack + kTiny : 0.0;
    }
  }
  const bool halved = (next_size_.array() <= 0.5 * size_.array()).all();
  size_.swap(next_size_);
  return halved;
}

/// Adds a term to the integral. Rounded upward.
void TransitionMatrix::integrate_magnitude(std::size_t k) {
  const double order = number(k + 1);
  for (Eigen::Index e = 0; e < size_.size(); ++e) integral_.data()[e] += size_.data()[e] / order;
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
  for (double& diagonal : magnitude_.diagonal()) diagonal = outward::add_up(diagonal, more);
  for (bool halved = false; !halved; ++k) {
    if (k > kMostPowers) return false;
    halved = next_magnitude(k, duration);
    rounded_upward([&] {
      integrate_magnitude(k);
      widen_by_tail(halved);
    });
    if (!(size_.array() <= outward::kLargest).all()) return false;
  }
  return true;
}

/// Adds a term of which only the size is known, and all that follow it if they are at most half of it.
/// Rounded upward.
void TransitionMatrix::widen_by_tail(bool halved) {
  for (Eigen::Index e = 0; e < size_.size(); ++e) {
    const double size = size_.data()[e];
    const double rest = halved ? 2.0 * size : size;
    const UpwardInterval tail(-rest, rest);
    end_.data()[e] += tail;
    range_.data()[e] += tail;
    if (halved) integral_.data()[e] += size;
  }
}

/// Multiplies by exp(-alpha s). Its integral against s^k is at most the product of both averages and h where
/// one falls and the other rises (Chebyshev).
void TransitionMatrix::apply_shift(const Interval& duration) {
  const Interval exponent = Interval(alpha_) * duration;
  const Interval decay = exp(-exponent);
  double average = std::max(decay.upper, 1.0);
  if (alpha_ > 0.0) average = std::min(average, ((kOne - decay) / exponent).upper);
  rounded_upward([&] {
    const UpwardInterval at_end(decay);
    const UpwardInterval during = hull(UpwardInterval(1.0), at_end);
    const double weight = average * duration.upper;
    for (Eigen::Index e = 0; e < size_.size(); ++e) {
      end_.data()[e] = end_.data()[e] * at_end;
      range_.data()[e] = range_.data()[e] * during;
      // No product of 0 and infinity.
      if (integral_.data()[e] > 0.0) integral_.data()[e] *= weight;
    }
  });
}

}  // namespace coordreq

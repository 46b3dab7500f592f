#include "reach/affine_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "reach/flow_sensitivity.hpp"

namespace coordreq {
namespace {

using outward::add_up;
using outward::multiply_up;

constexpr std::uint32_t kParts = 1U << 26U;

/// What may be left out of the kernel, relative to it.
constexpr double kPrecision = 1e-17;

double magnitude(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper));
}

bool is_same(std::span<const Interval> a, std::span<const Interval> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Interval& x, const Interval& y) {
    return x.lower == y.lower && x.upper == y.upper;
  });
}

}  // namespace

AffineKernel::AffineKernel(std::size_t states, std::size_t disturbances)
    : n_(states),
      m_(disturbances),
      transition_(states, TransitionMatrix::kManyTerms),
      system_(states * states),
      derivative_((kTerms + 1) * states),
      taylor_(kTerms + 1),
      row_(states),
      next_row_(states),
      none_damped_(states) {}

double AffineKernel::integral(const Jacobian& jacobian, const Interval& tau, std::size_t i, std::size_t l) {
  forget_unless_same(jacobian);
  double& known = known_[i * m_ + l];
  if (known >= 0.0) return known;
  set_system(jacobian, l);
  std::fill(row_.begin(), row_.end(), Interval{0.0, 0.0});
  row_[i] = {1.0, 1.0};
  double sum = 0.0;
  std::uint32_t left = kParts;
  std::uint32_t parts = kParts;
  expand();
  while (left > 0) {
    parts = std::min(parts, left);
    const double duration = multiply_up(tau.upper, static_cast<double>(parts) / kParts);
    if (add_piece(duration, parts == 1, sum)) {
      left -= parts;
      parts *= 2;
    } else if (parts == 1) {
      return outward::kInfinity;
    } else {
      parts /= 2;
    }
  }
  return known = sum;
}

void AffineKernel::forget_unless_same(const Jacobian& jacobian) {
  if (is_same(known_state_, jacobian.state()) && is_same(known_disturbance_, jacobian.disturbance())) return;
  known_state_.assign(jacobian.state().begin(), jacobian.state().end());
  known_disturbance_.assign(jacobian.disturbance().begin(), jacobian.disturbance().end());
  known_.assign(n_ * m_, -1.0);
}

void AffineKernel::set_system(const Jacobian& jacobian, std::size_t l) {
  std::copy(jacobian.state().begin(), jacobian.state().end(), system_.begin());
  for (std::size_t r = 0; r < n_; ++r) derivative_[r] = jacobian.disturbance()[r * m_ + l];
  for (std::size_t k = 1; k <= kTerms; ++k) {
    const auto before = std::span<const Interval>(derivative_).subspan((k - 1) * n_, n_);
    const Interval order{static_cast<double>(k), static_cast<double>(k)};
    for (std::size_t r = 0; r < n_; ++r) {
      const auto row = std::span<const Interval>(system_).subspan(r * n_, n_);
      derivative_[k * n_ + r] = scalar_product(row, before, 0, 1) / order;
    }
  }
}

/// Taylor coefficients of the kernel at the start of the next piece: row A^k b / k!.
void AffineKernel::expand() {
  for (std::size_t k = 0; k < kTerms; ++k) {
    const auto vector = std::span<const Interval>(derivative_).subspan(k * n_, n_);
    taylor_[k] = scalar_product(row_, vector, 0, 1);
  }
}

/// Bounds what the polynomial leaves out within `duration`: row exp(A theta) A^K b / K! duration^K.
double AffineKernel::remainder(double duration) {
  const auto last = std::span<const Interval>(derivative_).subspan(kTerms * n_, n_);
  for (std::size_t c = 0; c < n_; ++c) next_row_[c] = scalar_product(row_, transition_.range(), c, n_);
  const Interval power = coordreq::power(Interval{duration, duration}, static_cast<double>(kTerms));
  return magnitude(scalar_product(next_row_, last, 0, 1) * power);
}

/// @returns whether the piece was short enough
bool AffineKernel::add_piece(double duration, bool smallest, double& sum) {
  if (!transition_.enclose(system_, {duration, duration}, none_damped_)) return false;
  const double rest = remainder(duration);
  const Interval time{0.0, duration};
  const Interval end{duration, duration};
  Interval kernel{0.0, 0.0};
  Interval integral{0.0, 0.0};
  for (std::size_t k = kTerms; k-- > 0;) {
    const auto order = static_cast<double>(k + 1);
    kernel = kernel * time + taylor_[k];
    integral = integral * end + taylor_[k] / Interval{order, order};
  }
  const bool one_sign = kernel.lower >= 0.0 || kernel.upper <= 0.0;
  const bool precise = rest <= kPrecision * magnitude(kernel);
  if (!(one_sign && precise) && !smallest) return false;
  const double polynomial = one_sign ? magnitude(integral * end) : multiply_up(magnitude(kernel), duration);
  sum = add_up(sum, add_up(polynomial, multiply_up(rest, duration)));
  for (std::size_t c = 0; c < n_; ++c) next_row_[c] = scalar_product(row_, transition_.end(), c, n_);
  row_.swap(next_row_);
  expand();
  return true;
}

}  // namespace coordreq

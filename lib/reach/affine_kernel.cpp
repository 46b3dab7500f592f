#include "reach/affine_kernel.hpp"

#include <algorithm>

namespace coordreq {
namespace {

using outward::add_up;
using outward::multiply_up;

constexpr std::uint32_t kKernelTicks = 1U << 26U;

/// The fraction of the kernel that may be left out.
constexpr double kPrecision = 1e-17;

bool is_same(const IntervalMatrix& a, const IntervalMatrix& b) {
  const auto equal = [](const Interval& x, const Interval& y) {
    return x.lower == y.lower && x.upper == y.upper;
  };
  return a.rows() == b.rows() && a.cols() == b.cols() && a.binaryExpr(b, equal).all();
}

}  // namespace

AffineKernel::AffineKernel(std::size_t states)
    : transition_(states, TransitionMatrix::kManyTerms), none_damped_(states) {}

double AffineKernel::integral(const Jacobian& jacobian, const Interval& tau, std::size_t i, std::size_t l) {
  forget_unless_same(jacobian);
  double& known = known_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(l));
  if (known >= 0.0) return known;
  find_derivatives(static_cast<Eigen::Index>(l));
  row_ = IntervalRow::Unit(system_.rows(), static_cast<Eigen::Index>(i));
  double sum = 0.0;
  std::uint32_t left = kKernelTicks;
  std::uint32_t ticks = kKernelTicks;
  expand();
  while (left > 0) {
    ticks = std::min(ticks, left);
    const double duration = multiply_up(tau.upper, static_cast<double>(ticks) / kKernelTicks);
    if (add_piece(duration, ticks == 1, sum)) {
      left -= ticks;
      ticks *= 2;
    } else if (ticks == 1) {
      return outward::kInfinity;
    } else {
      ticks /= 2;
    }
  }
  return known = sum;
}

void AffineKernel::forget_unless_same(const Jacobian& jacobian) {
  if (is_same(system_, jacobian.state()) && is_same(disturbance_, jacobian.disturbance())) return;
  system_ = jacobian.state();
  disturbance_ = jacobian.disturbance();
  known_.setConstant(disturbance_.rows(), disturbance_.cols(), -1.0);
}

void AffineKernel::find_derivatives(Eigen::Index l) {
  derivative_.resize(system_.rows(), kTerms + 1);
  derivative_.col(0) = disturbance_.col(l);
  for (Eigen::Index k = 1; k <= kTerms; ++k) {
    derivative_.col(k) = product(system_, derivative_.col(k - 1)) / Interval(static_cast<double>(k));
  }
}

/// Taylor coefficients of the kernel at the start of the next piece: row A^k b / k!.
void AffineKernel::expand() {
  taylor_ = product(row_, derivative_.leftCols(kTerms));
}

/// Bounds what the polynomial leaves out within `duration`: row exp(A theta) A^K b / K! duration^K.
double AffineKernel::remainder(double duration) {
  const IntervalRow later = product(row_, to_intervals(transition_.range()));
  const Interval last = product(later, derivative_.col(kTerms)).value();
  return (last * power(Interval(duration), static_cast<double>(kTerms))).magnitude();
}

/// @returns whether the piece was short enough
bool AffineKernel::add_piece(double duration, bool smallest, double& sum) {
  if (!transition_.enclose(system_, Interval(duration), none_damped_)) return false;
  const double rest = remainder(duration);
  const Interval time{0.0, duration};
  const Interval end(duration);
  Interval kernel{0.0, 0.0};
  Interval integral{0.0, 0.0};
  for (Eigen::Index k = kTerms; k-- > 0;) {
    const auto order = static_cast<double>(k + 1);
    kernel = kernel * time + taylor_[k];
    integral = integral * end + taylor_[k] / Interval(order);
  }
  const bool one_sign = kernel.lower >= 0.0 || kernel.upper <= 0.0;
  const bool precise = rest <= kPrecision * kernel.magnitude();
  if (!(one_sign && precise) && !smallest) return false;
  const double polynomial =
      one_sign ? (integral * end).magnitude() : multiply_up(kernel.magnitude(), duration);
  sum = add_up(sum, add_up(polynomial, multiply_up(rest, duration)));
  row_ = product(row_, to_intervals(transition_.end())).eval();
  expand();
  return true;
}

}  // namespace coordreq

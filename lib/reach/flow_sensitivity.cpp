#include "reach/flow_sensitivity.hpp"

#include "base/requires.hpp"

namespace coordreq {
namespace {

using outward::add_up;
using outward::multiply_up;

/// A product of fewer matrices is hardly wider than that of a turning frame, which costs more than they do.
constexpr std::size_t kShortProduct = 8;

/// |Phi(h, 0)| before + (integral of |Phi|) acting, rounded up. @pre no entry is negative
template <class Sizes>
Sizes carried_on(const TransitionMatrix& transition, const Sizes& before, const Sizes& acting) {
  REQUIRES((before.array() >= 0.0).all() && (acting.array() >= 0.0).all());
  Sizes sizes = Sizes::Zero(before.rows(), before.cols());
  for (Eigen::Index i = 0; i < before.rows(); ++i) {
    for (Eigen::Index l = 0; l < before.cols(); ++l) {
      for (Eigen::Index k = 0; k < before.rows(); ++k) {
        const double old = multiply_up(transition.end()(i, k).magnitude(), before(k, l));
        const double now = multiply_up(transition.integral()(i, k), acting(k, l));
        sizes(i, l) = add_up(sizes(i, l), add_up(old, now));
      }
    }
  }
  return sizes;
}

}  // namespace

FlowSensitivity::FlowSensitivity(std::size_t states, std::size_t disturbances)
    : initial_(index(states), index(states)),
      turning_(index(states)),
      kernel_(index(states), index(disturbances)),
      weight_(index(states), index(disturbances)),
      jump_(index(states)) {
  reset();
}

void FlowSensitivity::reset() {
  bounded_ = true;
  first_ = true;
  initial_.setIdentity();
  turning_.reset();
  first_steps_.clear();
  kernel_.setZero();
  weight_.setZero();
  jump_.setZero();
}

/// The effect of earlier disturbances is carried on by Phi(h, 0), that of this step by Phi(h, s).
void FlowSensitivity::append(const TransitionMatrix& transition, const Jacobian& jacobian) {
  const IntervalMatrix now = product(transition.range(), jacobian.disturbance());
  const IntervalMatrix before = product(transition.end(), kernel_);
  kernel_ =
      first_ ? now : now.binaryExpr(before, [](const Interval& a, const Interval& b) { return hull(a, b); });
  const RealMatrix acting = magnitudes(jacobian.disturbance());
  weight_ = carried_on(transition, weight_, acting);
  jump_ = carried_on(transition, jump_, jacobian.jump());
  const IntervalMatrix initial = product(transition.end(), initial_);
  initial_ = first_ ? transition.end() : initial;
  intersect_with_turning(transition.end());
  first_ = false;
}

void FlowSensitivity::intersect_with_turning(const IntervalMatrix& transition) {
  if (!turns_) return;
  if (first_steps_.size() < kShortProduct) {
    first_steps_.push_back(transition);
    if (first_steps_.size() < kShortProduct) return;
    for (const IntervalMatrix& step : first_steps_) turning_.append(step);
  } else {
    turning_.append(transition);
  }
  for (Eigen::Index i = 0; i < initial_.rows(); ++i) {
    for (Eigen::Index j = 0; j < initial_.cols(); ++j)
      initial_(i, j) = intersect(initial_(i, j), turning_.entry(i, j)).value_or(initial_(i, j));
  }
}

void FlowSensitivity::lose() {
  bounded_ = false;
  first_ = false;
}

}  // namespace coordreq

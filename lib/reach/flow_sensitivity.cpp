#include "reach/flow_sensitivity.hpp"

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// A product of fewer matrices is hardly wider than that of a turning frame, which costs more than they do.
constexpr std::size_t kShortProduct = 8;

/// 0 times infinity is 0.
double times(double a, double b) {
  return a == 0.0 || b == 0.0 ? 0.0 : a * b;
}

/// |Phi(h, 0)| before + (integral of |Phi|) acting, rounded upward. @pre no entry is negative
template <class Sizes, class Acting>
void carry_sizes_on(const TransitionMatrix& transition, const Acting& acting, Sizes& sizes, Sizes& next) {
  REQUIRES((sizes.array() >= 0.0).all());
  for (Eigen::Index i = 0; i < sizes.rows(); ++i) {
    for (Eigen::Index l = 0; l < sizes.cols(); ++l) {
      double sum = 0.0;
      for (Eigen::Index k = 0; k < sizes.rows(); ++k) {
        const double old = times(transition.end()(i, k).magnitude(), sizes(k, l));
        sum += old + times(transition.integral()(i, k), acting(k, l));
      }
      next(i, l) = sum;
    }
  }
  sizes.swap(next);
}

}  // namespace

FlowSensitivity::FlowSensitivity(std::size_t states, std::size_t disturbances)
    : initial_(index(states), index(states)),
      turning_(index(states)),
      first_steps_(kShortProduct, UpwardMatrix(index(states), index(states))),
      kernel_(index(states), index(disturbances)),
      weight_(index(states), index(disturbances)),
      jump_(index(states)),
      next_initial_(index(states), index(states)),
      acting_(index(states), index(disturbances)),
      now_(index(states), index(disturbances)),
      before_(index(states), index(disturbances)),
      next_weight_(index(states), index(disturbances)),
      next_jump_(index(states)) {
  reset();
}

void FlowSensitivity::reset() {
  bounded_ = true;
  first_ = true;
  initial_.setIdentity();
  turning_.reset();
  step_count_ = 0;
  kernel_.setZero();
  weight_.setZero();
  jump_.setZero();
}

void FlowSensitivity::append(const TransitionMatrix& transition, const Jacobian& jacobian) {
  for (Eigen::Index e = 0; e < acting_.size(); ++e)
    acting_.data()[e] = UpwardInterval(jacobian.disturbance().data()[e]);
  rounded_upward([&] {
    add_disturbances(transition, jacobian);
    carry_on(transition);
  });
  if (turns_) append_to_turning(transition.end());
  first_ = false;
}

/// The effect of earlier disturbances is carried on by Phi(h, 0), that of this step by Phi(h, s).
void FlowSensitivity::add_disturbances(const TransitionMatrix& transition, const Jacobian& jacobian) {
  multiply(transition.range(), acting_, now_);
  if (first_) {
    kernel_.swap(now_);
  } else {
    multiply(transition.end(), kernel_, before_);
    for (Eigen::Index e = 0; e < kernel_.size(); ++e)
      kernel_.data()[e] = hull(now_.data()[e], before_.data()[e]);
  }
  const auto magnitude = [this](Eigen::Index k, Eigen::Index l) { return acting_(k, l).magnitude(); };
  carry_sizes_on(transition, magnitude, weight_, next_weight_);
  const auto jump = [&jacobian](Eigen::Index k, Eigen::Index) { return jacobian.jump()(k); };
  carry_sizes_on(transition, jump, jump_, next_jump_);
}

void FlowSensitivity::carry_on(const TransitionMatrix& transition) {
  if (first_) {
    initial_ = transition.end();
  } else {
    multiply(transition.end(), initial_, next_initial_);
    initial_.swap(next_initial_);
  }
}

void FlowSensitivity::append_to_turning(const UpwardMatrix& transition) {
  if (step_count_ < kShortProduct) {
    first_steps_[step_count_++] = transition;
    if (step_count_ < kShortProduct) return;
    for (const UpwardMatrix& step : first_steps_) turning_.append(step);
  } else {
    turning_.append(transition);
  }
  const UpwardMatrix& turned = turning_.enclosure();
  for (Eigen::Index e = 0; e < initial_.size(); ++e)
    initial_.data()[e] = intersection(initial_.data()[e], turned.data()[e]);
}

void FlowSensitivity::lose() {
  bounded_ = false;
  first_ = false;
}

}  // namespace coordreq

#pragma once

#include <Eigen/Core>

#include <cstddef>

namespace coordreq {

/// One step of the Runge-Kutta pair of orders 5 and 4 of Dormand and Prince (1980),
/// doi 10.1016/0771-050X(80)90013-3, with its interpolant of order 4 (Hairer, Norsett, Wanner 1993, Solving
/// Ordinary Differential Equations I, section II.6).
class DormandPrince {
 public:
  using Values = Eigen::VectorXd;

  explicit DormandPrince(std::size_t dimension);

  /// A step of length h of x' = f(x); `f(x, result)` writes f(x) to `result`.
  template <class Field>
  void step(const Field& f, const Values& x, double h) {
    start_ = x;
    step_ = h;
    for (Eigen::Index stage = 0; stage < kStages; ++stage) {
      end_ = start_ + h * increment(stage);
      f(end_, derivative_);
      slopes_.col(stage) = derivative_;
    }
  }

  /// The state at the end of the step, of order 5.
  [[nodiscard]] const Values& end() const { return end_; }
  /// Its estimated error.
  [[nodiscard]] Values error() const;
  /// About the step times the magnitude of the fastest rate of change of a difference of solutions, from the
  /// two stages at the end of the step (section IV.2 of volume II): where that is above 3 stability bounds
  /// the step, and not the error.
  [[nodiscard]] double stiffness() const;
  /// The state after `share` of the step, 0 <= share <= 1.
  void interpolate(double share, Values& x) const;

 private:
  static constexpr Eigen::Index kStages = 7;

  /// The increment of a stage over the start, divided by h.
  [[nodiscard]] Values increment(Eigen::Index stage) const;

  Values start_;
  Values end_;
  Values derivative_;
  double step_ = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, kStages> slopes_;
};

}  // namespace coordreq

#pragma once

#include <Eigen/Core>

#include <functional>
#include <span>

namespace coordreq {

/// Steps of x' = f(x) by the Radau IIA method of five stages and order 9 (Hairer, Wanner 1996, Solving
/// Ordinary Differential Equations II, section IV.8): collocation, solved by Newton steps with a Jacobian of
/// differences. It is L-stable: steps are as long as the solution is smooth, however fast what decays to it
/// would decay.
///
/// Scratch memory for one thread.
class StiffSolver {
 public:
  using Values = Eigen::VectorXd;
  /// Writes f(x) to the second argument, not finite where it is undefined.
  using Field = std::function<void(const Values&, Values&)>;

  /// @param tolerance of the estimated error of a step, relative to the larger of the state and its `scale`
  StiffSolver(Field field, std::span<const double> scale, double tolerance);

  /// Begins at x, forgetting what was before.
  void begin(const Values& x);
  /// One step, not longer than `most`. @returns its length, > 0; 0 if none was found
  [[nodiscard]] double step(double most);
  /// The state after `share` of the last step, 0 <= share <= 1: its collocation polynomial, of order 5, whose
  /// error is the one that is estimated.
  void interpolate(double share, Values& x) const;

 private:
  static constexpr Eigen::Index kStages = 5;
  using Stages = Eigen::Matrix<double, Eigen::Dynamic, kStages>;

  [[nodiscard]] double first_length() const;
  bool differentiate();
  bool solve(double h);
  [[nodiscard]] double relative_error(double h) const;
  [[nodiscard]] double relative(const Values& difference) const;

  Field field_;
  Values scale_;
  double tolerance_;
  Values x_;           ///< where the next step begins
  Values from_;        ///< where the last one began
  Values derivative_;  ///< at x_
  Eigen::MatrixXd jacobian_;
  Stages increments_;    ///< of the stages over the start of the step
  double length_ = 0.0;  ///< to be tried next; 0: nothing is known of it
  double time_ = 0.0;    ///< since begin()
};

}  // namespace coordreq

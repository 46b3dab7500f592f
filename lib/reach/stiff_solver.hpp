#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <span>

namespace coordreq {

/// Steps of x' = f(x) by backward differentiation formulas of variable order and step: CVODE of SUNDIALS
/// (Hindmarsh et al. 2005, doi 10.1145/1089014.1089020) with dense Newton steps. Steps are as long as the
/// solution is smooth, however fast what decays to it would decay.
///
/// Scratch memory for one thread.
class StiffSolver {
 public:
  using Values = Eigen::VectorXd;
  /// Writes f(x) to the second argument, not finite where it is undefined.
  using Field = std::function<void(const Values&, Values&)>;

  /// @param tolerance of the estimated error of a step, relative to the larger of the state and its `scale`
  StiffSolver(Field field, std::span<const double> scale, double tolerance);
  ~StiffSolver();
  StiffSolver(StiffSolver&&) noexcept;
  StiffSolver& operator=(StiffSolver&&) noexcept;

  /// Begins at x, forgetting what was before.
  void begin(const Values& x);
  /// One step, not longer than `most`. @returns its length, > 0; 0 if none was found
  [[nodiscard]] double step(double most);
  /// The state after `share` of the last step, 0 <= share <= 1.
  void interpolate(double share, Values& x) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// One solution of the differential equations of some states in double arithmetic, for simulation: accurate,
/// with no guarantee, and independent of the validated integration that the abstraction uses.
///
/// The Runge-Kutta pair of orders 5 and 4 of Dormand and Prince (1980), doi 10.1016/0771-050X(80)90013-3,
/// each sub-step's estimated error held below 1e-12 of the larger of the state and its grid step. The
/// instants at which a state reaches or leaves a `stop` limit are found by halving sub-steps, to 2^-40 of the
/// period. Where f jumps, sub-steps end at 2^-36 of the period, and after 5000 of them at 2^-10, so that no
/// sliding motion takes for ever. Scratch inside: one object a thread.
class PointFlow {
 public:
  /// @param moving states that are integrated, closed under the equations
  /// REQUIRES: `spec` outlives this object.
  PointFlow(const ProblemSpec& spec, std::span<const std::int32_t> moving);

  /// Values of the moving states, in their order, after one period from `slots`, in which everything else
  /// stays constant. @returns nothing if the solution is undefined on the way or not finite
  [[nodiscard]] std::optional<std::vector<double>> after_period(std::span<const double> slots);

 private:
  using Values = std::vector<double>;
  struct Limit {
    double lower, upper;  ///< infinite where there is none
  };

  void find_held(const Values& x);
  void derivative(const Values& x, Values& result);
  [[nodiscard]] double raw_derivative(std::size_t i, const Values& x);
  [[nodiscard]] double step(const Values& x, double h, Values& next);
  [[nodiscard]] bool misses_event(const Values& next);

  double period_;
  std::vector<std::uint32_t> slots_of_states_;
  std::vector<Evaluator<double>> equations_;
  std::vector<Limit> limits_;
  std::vector<double> scale_;  ///< grid steps
  std::vector<double> slots_;
  std::vector<int> held_;  ///< -1 or 1: held at its lower or upper limit
  std::vector<Values> stages_;
  Values stage_point_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "reach/dormand_prince.hpp"
#include "reach/flow_system.hpp"

namespace coordreq {

/// How far solutions from a box diverge from one another, in double arithmetic and without limits
/// and seams: a guess that proves nothing. It tells into which subboxes a box is worth dividing before any of
/// them is enclosed.
///
/// Scratch memory for one thread. @pre unchecked: the equations outlive it.
class SolutionSpread {
 public:
  /// @pre `system.steps` is not empty
  SolutionSpread(const FlowSystem& system, double period);

  /// Where some solutions from the middle of the box and from the middles of its sides are at times farther
  /// than `limit` steps of the grid from one another: the state along which these sides lie.
  /// @param slots values of all that is constant; @param box one interval a state
  /// @returns nothing if they are not, or cannot be followed in so few steps
  [[nodiscard]] std::optional<std::size_t> widest(std::span<const Interval> slots,
                                                  std::span<const Interval> box, double limit);
  /// Sub-steps that were tried so far.
  [[nodiscard]] std::int64_t tries() const { return all_tries_; }

 private:
  using Values = DormandPrince::Values;
  using Path = Eigen::MatrixXd;  ///< [state, time]

  [[nodiscard]] bool follow(Values x, Path& path);
  [[nodiscard]] bool advance(Values& x, double duration);
  void derivative(const Values& x, Values& result);
  [[nodiscard]] double error_in_steps() const;

  double period_;
  std::vector<Evaluator<double>> equations_;
  std::vector<std::uint32_t> state_slots_;
  std::vector<double> steps_;
  DormandPrince pair_;
  std::vector<double> slots_;
  double step_ = 0.0;  ///< that went well last
  int tries_ = 0;      ///< for the present solution
  std::int64_t all_tries_ = 0;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "reach/dormand_prince.hpp"
#include "reach/stiff_solver.hpp"
#include "reach/switched_equation.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// One solution of the differential equations of some states in double arithmetic, for simulation: accurate,
/// with no guarantee, and independent of the validated integration that the abstraction uses.
///
/// Each sub-step's estimated error is held below a fraction of the larger of the state and its grid step. An
/// explicit pair takes them; where stability bounds their length StiffSolver takes over. Events end a
/// sub-step: a state that reaches or leaves a `stop` limit or passes its seam, a switch of an equation
/// (SwitchedEquation). Between events everything is smooth, so they are found on the interpolant of a
/// sub-step, to 2^-50 of it. Two events that undo one another within an eighth of a sub-step are not seen.
///
/// A solution that slides along a place where f jumps passes it to and fro: after 50 events in short
/// succession the next ones are only looked for 2^-12 of the period later, or when a state has moved by 2^-6
/// of its grid step, whatever comes first. One that is so fast on both sides that this takes very many
/// sub-steps is not followed to its end.
///
/// Scratch memory for one thread.
class PointFlow {
 public:
  static constexpr double kAccurate = 1e-12;
  /// For many solutions, of which single ones may be left out.
  static constexpr int kFewSteps = 20'000;

  /// @param moving states that are integrated, closed under the equations
  /// @param tolerance of the estimated error of a sub-step, relative to the larger of state and grid step
  /// @param most sub-steps that are tried; a solution that takes more is not followed to its end
  /// @pre unchecked: `spec` outlives this object.
  PointFlow(const SystemSpec& spec, std::span<const std::int32_t> moving, double tolerance = kAccurate,
            int most = std::numeric_limits<int>::max());
  PointFlow(const PointFlow&) = delete;
  PointFlow& operator=(const PointFlow&) = delete;

  /// Values of the moving states, in their order, after one period from `slots`, in which everything else
  /// stays constant. Periodic states are not wrapped: what they have turned counts.
  /// @returns nothing if the solution is undefined on the way or not finite, or takes too many sub-steps
  [[nodiscard]] std::optional<std::vector<double>> after_period(std::span<const double> slots);
  /// The share of the period up to which the last solution was followed; 1 if that was all of it.
  [[nodiscard]] double followed() const { return followed_; }
  /// Sub-steps that were tried for all solutions so far.
  [[nodiscard]] std::int64_t tried() const { return tried_; }

 private:
  using Values = DormandPrince::Values;

  /// Where a state stays within, its `stop` limits or one period; infinite where there is no end.
  struct Range {
    double lower;
    double upper;
    bool wraps;
  };

  [[nodiscard]] static Range range_of(const StateSpec& state, bool is_used);
  bool advance(double& left, double& h);
  bool advance_stiffly(double& left, double& h);
  void begin_stiffly();
  void interpolate(double share, Values& x) const;
  void settle();
  void derivative(const Values& x, Values& result);
  void put(const Values& x);
  [[nodiscard]] double relative_error() const;
  [[nodiscard]] bool is_sliding() const;
  [[nodiscard]] double dwell();
  [[nodiscard]] double share_until_event(double h);
  [[nodiscard]] bool is_event(double share);

  double period_;
  double tolerance_;
  int most_;
  std::vector<std::uint32_t> slots_of_states_;
  std::vector<SwitchedEquation> equations_;
  std::vector<Range> ranges_;
  std::vector<double> scale_;  ///< grid steps
  bool has_events_ = false;

  DormandPrince pair_;
  std::optional<StiffSolver> stiff_;  ///< from when on it is needed
  bool is_stiff_ = false;             ///< it takes the sub-steps of this period
  std::vector<double> slots_;
  Values x_;
  Values point_;
  std::vector<double> turned_;  ///< what the seam has taken off a state
  std::vector<int> held_;       ///< -1 or 1: held at its lower or upper limit
  int steps_ = 0;
  int stiff_steps_ = 0;  ///< those that stability bounds
  int short_events_ = 0;
  double followed_ = 1.0;
  std::int64_t tried_ = 0;
};

}  // namespace coordreq

#pragma once

#include "verify/arb.hpp"
#include "verify/flow_tube.hpp"

namespace coordreq {

/// Encloses all transition matrices of e' = A(t) e over `duration`, for every A(t) within `slopes`: the
/// Peano-Baker series sum_k J^k h^k / k!, its tail bounded by powers of a norm, only where a path of
/// influence exists. @pre `duration` is not negative
[[nodiscard]] ArbMatrix transition_matrix(const ArbMatrix& slopes, const Arb& duration);

/// The values of all states of x' = f(x, w) after a period, or after some of its steps.
///
/// 1. A tube of all solutions (enclose_flow()), and with it bounds. Where more effort is required it is
/// narrowed
///    around the solution from the middle by the mean value theorem of 2.
/// 2. Two solutions x, y for different starts and disturbances v, w differ by e with e' = A(t) e + B(t) (v -
/// w), A and B
///    within the slopes over the tube (a mean value theorem that holds with kinks, too). So the row of a
///    state in bounds of the transition matrices tells how its end depends on the start, and on the
///    disturbance during each step, whatever measurable signal that is.
/// 3. A solution from the place, and with the disturbances, that these signs say is extreme; where a sign is
///    open the rest is added. Cells that meet in a corner share the solutions from there.
/// 4. Where the tube passes a seam at which equations jump, it is made anew with what they are on both sides;
///    then bounds are those of the tube.
///
/// Scratch inside: one object a thread.
class FlowExtremes : public NextValue {
 public:
  /// @param cell the shortest step of the states' grids, for tolerances
  /// @pre unchecked: `spec` outlives this object.
  FlowExtremes(const SystemSpec& spec, const Influences& influences, double cell);

  /// Makes the tube.
  [[nodiscard]] bool enclose(const SpanBox& box, const Effort& effort) override;
  /// @param state its place among the moving ones
  [[nodiscard]] Extremes extremes(std::size_t state, const Enough& enough) override;
  /// With slopes all over the tube solutions are unique, so that for every signal of the disturbances the
  /// flow maps the interior of a box to an open set (invariance of domain): no state has an extreme there. A
  /// box that is a point in some state has no interior.
  [[nodiscard]] bool has_extremes_on_faces() const override;
  [[nodiscard]] const std::vector<std::uint32_t>& divisible() const override { return states_; }

  [[nodiscard]] Work work() const override { return field_.work(); }
  void limit_work(Work most) override { field_.limit_work(most); }
  [[nodiscard]] bool is_spent() const override { return field_.is_spent(); }

  [[nodiscard]] const std::vector<TubeStep>& steps() const { return steps_; }
  /// The extreme after so many steps.
  [[nodiscard]] Extreme extreme_after(std::size_t steps, std::size_t state, bool greatest);
  [[nodiscard]] const Arb& duration_of_step() const { return step_; }
  [[nodiscard]] SeriesField& field() { return field_; }

 private:
  /// On each state (rows), by bounds.
  struct Influence {
    ArbMatrix of_start;                     ///< of each moving state
    std::vector<ArbMatrix> of_disturbance;  ///< [step]: of each disturbance, per time
  };
  [[nodiscard]] bool find_steps();
  [[nodiscard]] std::optional<std::vector<TubeStep>> enclosed(int steps);
  [[nodiscard]] bool passes_a_seam() const;
  [[nodiscard]] int steps_for(const ArbMatrix& slopes, const Effort& effort) const;
  [[nodiscard]] const std::optional<Influence>& influence_after(std::size_t steps);
  [[nodiscard]] std::optional<Influence> find_influence(std::size_t steps);
  [[nodiscard]] Extreme bound_after(std::size_t steps, std::size_t state, bool greatest) const;
  void follow(const Influence& influence, std::size_t state, bool greatest, Extreme& extreme);
  [[nodiscard]] bool move_on(ArbBox& now, const std::vector<std::vector<Arb>>& signal);

  SeriesField field_;
  std::vector<StopLimits> limits_;  ///< [moving state]
  std::vector<Seam> seams_;         ///< at which equations jump
  Trajectory trajectory_;
  std::vector<std::uint32_t> states_;
  std::vector<std::uint32_t> disturbances_;
  Arb period_;
  double cell_;
  SpanBox box_;
  Effort effort_;
  Arb step_;
  std::vector<TubeStep> steps_;
  std::vector<std::optional<std::optional<Influence>>> influences_;  ///< [steps]
};

/// The range of one state at all times of the period.
struct FlowRange {
  Arb lower;  ///< points; no value is beyond them
  Arb upper;
  bool stays_above_start =
      false;  ///< no solution gets below the box that it begins in; then `lower` does not matter
  bool stays_below_start = false;
  std::optional<Arb> low;   ///< some solution is at or below it at some later time
  std::optional<Arb> high;  ///< or at or above it
};

/// Bounds of one state of a differential equation at all times of the period, from a box of states.
///
/// Where its derivative keeps its sign the state lies between its bounds at both ends of that time
/// (FlowExtremes), elsewhere it moves from where it was at the beginning of a step as far as the derivative
/// says.
/// @param state its place among the moving ones
/// @returns nothing where there are no bounds
[[nodiscard]] std::optional<FlowRange> range_during_period(FlowExtremes& flow, std::size_t state,
                                                           const SpanBox& box, const Effort& effort);

}  // namespace coordreq

#pragma once

#include <span>
#include <vector>

#include "reach/a_priori.hpp"
#include "reach/sensitivity.hpp"
#include "reach/taylor_series.hpp"

namespace coordreq {

/// Lagrange's remainder of one step in time, valid for every solution that stays in some box.
struct TaylorRemainder {
  bool bounded = true;          ///< false if a Taylor coefficient has no bound over the box
  std::size_t order = 0;        ///< degree of the polynomial plus one; 0 if there is no usable remainder
  std::vector<Interval> value;  ///< h^order x^[order] over the box, a state
};

/// One validated step in time: a Taylor polynomial about the state with the remainder over a box that holds
/// the solution during the step. Scratch memory for one thread.
class TaylorStep {
 public:
  /// Solutions whose steps can be found along with the remainder.
  static constexpr std::size_t kMostAlong = TaylorSeries::kLanes - 1;

  /// @pre unchecked: the tape outlives it.
  explicit TaylorStep(const FlowTape& tape);

  /// Begins a step over a box.
  /// @param field evaluated at the box last
  /// @param choices decided for the box, no kink undecided
  /// @param held states that are kept constant
  void begin(const VectorField& field, const Choices& choices, const std::vector<bool>& held);
  /// Takes along what starts from a box within it. @pre unchecked: after
  /// begin(), fewer than kMostAlong times
  void take_along(std::span<const Interval> slots) { box_series_.add_box(slots); }
  /// Finds the least order whose remainder is narrower than `tolerance` for every state, if there is one.
  void find_remainder(const Interval& duration, std::span<const double> tolerance,
                      TaylorRemainder& remainder);
  /// Whether a step twice as long could have a remainder, by the coefficients over this one's box, which lies
  /// in that of the longer step. @pre unchecked: as find_remainder(), which has found one
  [[nodiscard]] bool could_be_doubled(const Interval& duration, std::span<const double> tolerance);
  /// Where the solutions are after the step that were taken along as number `along`. @pre unchecked: there is
  /// a remainder
  void advance_along(std::size_t along, const TaylorRemainder& remainder, std::span<Interval> state) const;

  /// How far state i can get from a straight line in time between its ends of the step. @pre unchecked: there
  /// is a remainder
  [[nodiscard]] Interval bend(std::size_t i, const Interval& duration) const;

  /// Replaces `state` by an enclosure of where the solutions from it are after `duration`.
  /// @param field its slots hold the disturbances' values; its states are overwritten
  void advance(VectorField& field, const Interval& duration, const Choices& choices,
               const std::vector<bool>& held, const TaylorRemainder& remainder, std::span<Interval> state);

 private:
  bool is_bounded(const Ball& power);
  bool is_narrow(std::span<const double> tolerance, std::vector<Interval>& value) const;

  std::size_t dimension_;
  TaylorSeries box_series_;  ///< in lane 0; what is taken along in the others
  TaylorSeries state_series_;
  std::vector<Ball> terms_;      ///< of the last order over the box
  std::vector<BallLanes> sums_;  ///< the polynomials of all states at the end of the step
};

/// The derivative of one step by its start, by Taylor series of e' = J(x) e along all solutions at once: far
/// narrower than what an interval Jacobian over the whole step leads to. Scratch memory for one thread.
class TangentStep {
 public:
  /// @param tape with tangents of this system
  TangentStep(FlowTape tape, const FlowSystem& system);

  /// Sets the slots that are constant in time.
  void begin(std::span<const Interval> slots);
  /// Narrows the end of `transition`, the difference of two solutions of a smooth system without
  /// disturbances.
  /// @param start where all solutions start that it is asked for
  /// @param box where they are during the step, no damping there
  /// @param order as of the remainder
  void narrow(std::span<const Interval> start, std::span<const Interval> box, const Interval& duration,
              std::size_t order, TransitionMatrix& transition);

 private:
  void add_lanes(std::span<const Interval> start, std::span<const Interval> box,
                 const TransitionMatrix& transition, Eigen::Index column);
  void add_lane(std::span<const Interval> state);

  std::size_t dimension_;
  FlowTape tape_;
  TapeValues<Interval> fixed_;
  TaylorSeries series_;
  std::vector<Interval> slots_;
  Choices choices_;  ///< there are none
  std::vector<bool> none_held_;
  std::vector<Eigen::Index> columns_;  ///< that are not known well yet
};

}  // namespace coordreq

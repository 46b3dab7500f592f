#pragma once

#include <span>
#include <vector>

#include "reach/a_priori.hpp"
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
  /// @pre unchecked: the tape outlives it.
  explicit TaylorStep(const FlowTape& tape);

  /// Finds the least order whose remainder is narrower than `tolerance` for every state, if there is one.
  /// @param field evaluated at the box last
  /// @param choices decided for the box, no kink undecided
  /// @param held states that are kept constant
  void find_remainder(const VectorField& field, const Interval& duration, const Choices& choices,
                      const std::vector<bool>& held, std::span<const double> tolerance,
                      TaylorRemainder& remainder);

  /// Replaces `state` by an enclosure of where the solutions from it are after `duration`.
  /// @param field its slots hold the disturbances' values; its states are overwritten
  void advance(VectorField& field, const Interval& duration, const Choices& choices,
               const std::vector<bool>& held, const TaylorRemainder& remainder, std::span<Interval> state);

 private:
  [[nodiscard]] bool is_bounded(const Ball& power) const;
  bool is_narrow(const Ball& power, std::span<const double> tolerance, std::vector<Interval>& value) const;

  std::size_t dimension_;
  TaylorSeries over_box_;
  TaylorSeries at_state_;
};

}  // namespace coordreq

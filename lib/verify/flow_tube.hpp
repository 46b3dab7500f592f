#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "verify/map_extremes.hpp"
#include "verify/trajectory.hpp"

namespace coordreq {

/// One step of an enclosure of all solutions of x' = f(x, w) from a box, for every measurable w.
struct TubeStep {
  ArbBox tube;              ///< holds all solutions during the step
  std::vector<Arb> change;  ///< and this their derivatives
  /// Derivatives of f by x and w, all over the tube; none where f jumps, or a state may be held.
  std::optional<ArbMatrix> slopes;
  SpanBox end;  ///< holds all solutions at its end
  /// Transition matrix of the states over the step, once it has been needed.
  std::optional<ArbMatrix> transition = {};
};

/// Encloses by differential inequalities (Mueller, Math. Z. 26, 1927): the upper end of each state grows as
/// fast as its derivative can be where that state is at its upper end and the others anywhere between theirs;
/// taken at the beginning of a step, and with a bound of how it changes during the step.
/// A state that may be held has a derivative of 0 as well, and its upper end is, after the last time at the
/// lower limit, no farther than it can have come from there.
/// @param limits one a state; @param duration of the whole, a point
/// @param pieces that disturbances are cut into where that matters
/// @param narrow may narrow the end of each step before the next one begins there
/// @returns nothing where some solution may not last so long
[[nodiscard]] std::optional<std::vector<TubeStep>> enclose_flow(
    SeriesField& field, const std::vector<StopLimits>& limits, const SpanBox& start, const Arb& duration,
    int steps, int pieces, const std::function<void(TubeStep&)>& narrow = {});

}  // namespace coordreq

#pragma once

#include "verify/flow_extremes.hpp"

namespace coordreq {

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

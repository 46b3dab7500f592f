#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "expression/program.hpp"
#include "numeric/interval.hpp"

namespace coordreq {

/// x' = f(x, u, w) for a closed set of states: no equation mentions a state that is not among them.
/// Slots that are neither states nor disturbances (inputs, parameters) are constant in time.
struct FlowSystem {
  /// `outside: "stop"`: the state never passes the limit; at it the derivative is 0 while f points out.
  struct Limit {
    bool below = false;  ///< whether there is a lower limit
    bool above = false;
    Interval lower;  ///< encloses the limit
    Interval upper;
  };

  std::vector<const Program*> equations;  ///< one a state; they outlive whoever uses the system
  std::vector<std::uint32_t> state_slots;
  /// Steps of the grid, one a state: what is much shorter makes no difference to a post. Empty: nothing is
  /// too short.
  std::vector<double> steps;
  std::vector<std::uint32_t> disturbance_slots;
  std::size_t slot_count = 0;
  std::vector<Limit> stops;  ///< one a state, or none at all
  /// Whether something is added to the end of a solution before cells are counted, so that all that matters
  /// is its distance from the true end, and nothing before the end does.
  bool summed = false;
  /// Enclosures of where the equations jump in a state that goes round (see seam.hpp): one list a state, or
  /// none at all.
  std::vector<std::vector<Interval>> seams;
};

/// Whether a box is wide in one direction alone.
[[nodiscard]] inline bool is_line(std::span<const Interval> box) {
  return std::count_if(box.begin(), box.end(), [](const Interval& a) { return !a.is_point(); }) == 1;
}

}  // namespace coordreq

#pragma once

#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "verify/flow_bounds.hpp"

namespace coordreq {

/// What is known of one state at all times of the period.
struct FlowTube {
  Interval values;  ///< all are in it
  /// How far they are beyond the initial box: exactly 0 on a side that no solution leaves it at. For rounding
  /// that box alone widens `values`.
  Interval beyond;
  /// Some solution is at or below `low`, and some at or above `high`, at some later time; infinite if no time
  /// was looked at.
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// Bounds of one state of a differential equation at all times of the period, from a box of states.
///
/// The period is cut into equal parts. Over each of them the derivative of the state is bounded along all
/// solutions (FlowBounds::motion()). Where it keeps its sign the state lies between its bounds at the ends of
/// those parts, elsewhere it moves from where it was at the beginning as far as the derivative says.
///
/// Over-approximates. Not thread-safe: one object a thread.
class TubeBounds {
 public:
  /// REQUIRES: as FlowBounds.
  TubeBounds(const ProblemSpec& spec, const Influences& influences, std::size_t state)
      : spec_(&spec), influences_(&influences), state_(state), whole_(spec, influences, state) {}

  /// @param parts of the period; @param halvings of the box, as for FlowBounds::ends()
  /// @returns nothing where there are no bounds
  [[nodiscard]] std::optional<FlowTube> over(const std::vector<Interval>& slots, int parts, int halvings);

 private:
  [[nodiscard]] bool visit_run(const std::vector<Interval>& slots, int begin, int end, const Interval& slope,
                               FlowTube& tube);
  [[nodiscard]] bool go_to(const std::vector<Interval>& slots, int part);

  const ProblemSpec* spec_;
  const Influences* influences_;
  std::size_t state_;
  FlowBounds whole_;
  std::map<Rational, FlowBounds> until_;  ///< by duration
  int parts_ = 1;
  int halvings_ = 0;
  int at_ = 0;            ///< beginning of a part
  FlowBounds::Ends now_;  ///< there
};

}  // namespace coordreq

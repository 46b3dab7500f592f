#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reach/flow_system.hpp"
#include "reach/flow_tape.hpp"
#include "reach/tape_values.hpp"
#include "reach/turning_polygon.hpp"
#include "reach/validated_flow.hpp"

namespace coordreq {

/// Encloses what two states can reach by a convex polygon, so that it is not forgotten what they have to do
/// with each other while disturbances multiply them:
///
///     x' = A(w) x + b(w),  A and b of degree 1 in each disturbance, w(t) any measurable signal in a box.
///
/// Over-approximates: the convex hull of what can be reached for ever more steps and sides. Scratch memory
/// for one thread.
class PlanarFlow {
 public:
  /// @pre unchecked: system and tape outlive it.
  PlanarFlow(const FlowSystem& system, const FlowTape& tape);

  /// Whether the system has the form above, with a disturbance that multiplies a state, and neither limits
  /// nor seams.
  [[nodiscard]] bool applies() const { return applies_; }

  /// Narrows an enclosure of all solutions in the period, if it can. @pre applies()
  /// @param slots as in ValidatedFlow::flow()
  void narrow(std::span<const Interval> slots, const Interval& period, FlowEnclosure& known);

 private:
  /// The equations for disturbances at a vertex of their box, both states divided by their scales.
  struct Corner {
    std::array<std::array<Interval, 2>, 2> matrix;
    std::array<Interval, 2> constant;
  };

  bool find_corners(std::span<const Interval> slots);
  bool add_corner();
  bool find_bounds();
  [[nodiscard]] TurningPolygon::Vector changes(const std::array<Interval, 2>& box) const;
  [[nodiscard]] static Interval times(const Corner& corner, std::size_t i, const std::array<Interval, 2>& x);
  [[nodiscard]] bool is_exact(const Corner& corner) const;
  void begin(const std::array<Interval, 2>& start, double steps);
  bool follow(const std::array<Interval, 2>& start, const Interval& period);

  const FlowSystem* system_;
  const FlowTape* tape_;
  bool applies_;
  TapeValues<Dual> values_;
  std::vector<Dual> slots_;
  std::array<int, 2> scale_{};    ///< powers of two
  std::array<Interval, 2> tube_;  ///< what is known of the scaled states, and narrowed
  std::array<Interval, 2> end_;
  std::array<Interval, 2> speed_;
  std::vector<Corner> corners_;
  TurningPolygon::Bounds bounds_{};
  double fastest_turn_ = 0.0;
  TurningPolygon polygon_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "reach/flow_system.hpp"

namespace coordreq {

/// An end of the bounds of a state during a step: it is at `start` + r `rate` after a time r.
struct MovingEnd {
  double start = 0.0;
  Interval rate;

  [[nodiscard]] Interval during(double duration) const {
    return Interval{start, start} + Interval{0.0, duration} * rate;
  }
};

/// Bounds of all states during a step.
struct MovingBounds {
  std::vector<MovingEnd> lower;
  std::vector<MovingEnd> upper;
  std::vector<Interval> box;  ///< all states of the step, also if the bounds above turn out too narrow
  double duration = 0.0;
};

/// The right-hand side of one state on the faces of boxes.
///
/// Over-approximates. Scratch memory for one thread.
class FaceSlope {
 public:
  /// How fast an end of a state's bounds must move outward, at least.
  struct Bound {
    bool found = false;   ///< else the equation jumps there, or is too steep, or not defined
    double start = 0.0;   ///< at the start of the step
    double end = 0.0;     ///< at its end; in between the speed is convex in time
    double least = 0.0;   ///< the speed is never below this, nor above both others
    double spread = 0.0;  ///< what of `end` may be due to the wrong derivatives
    double decay = 0.0;   ///< the least derivative of the equation by its own state
  };

  /// @pre unchecked: the system outlives this object.
  FaceSlope(const FlowSystem& system, std::size_t state);

  /// Sets what is constant in time, and the disturbances' boxes.
  void begin(std::span<const Interval> slots);

  /// The right-hand side over a box of the states, by intervals.
  [[nodiscard]] Interval on_box(std::span<const Interval> box);

  /// The largest (or least) value on the moving face where the state itself is at its upper (lower) end and
  /// the others are within their bounds, over all disturbances. Monotone variables are put at the end where
  /// the extreme is, the boxes of disturbances are divided.
  /// @param negligible what a disturbance need not be divided for
  [[nodiscard]] Bound on_face(const MovingBounds& bounds, bool upper, double negligible);

 private:
  enum class At : std::uint8_t { lower, upper, anywhere };
  struct Subbox {
    std::vector<Interval> disturbance;  ///< one for each of disturbances_
    Bound bound;
    std::size_t widest = 0;  ///< the disturbance that matters most of those without a sign
    double width = 0.0;      ///< by how much it may change the value; 0: there is none
  };

  void examine(const MovingBounds& bounds, bool upper, Subbox& subbox);
  void set_states(const MovingBounds& bounds, bool upper, bool at_start);
  bool differentiate();
  bool use_signs(bool upper, Subbox& subbox);
  [[nodiscard]] Interval value_at_start(const MovingBounds& bounds, bool upper);
  [[nodiscard]] Interval rate_of_change(const MovingBounds& bounds, bool upper) const;
  void find_widest(Subbox& subbox) const;

  const FlowSystem* system_;
  std::size_t state_;
  Evaluator<Interval> value_;
  Evaluator<Dual> derivative_;
  std::vector<std::size_t> states_;        ///< that the equation mentions, and the state itself
  std::vector<std::size_t> disturbances_;  ///< that it mentions
  std::vector<Interval> slots_;
  std::vector<Dual> dual_;
  std::vector<Interval> gradient_;  ///< by states_, then by disturbances_
  std::vector<At> at_;              ///< of states_
  std::vector<Subbox> subboxes_;
};

}  // namespace coordreq

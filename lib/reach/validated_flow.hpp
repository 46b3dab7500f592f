#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reach/flow_system.hpp"

namespace coordreq {

/// An enclosure of the solutions of a FlowSystem from a box of initial states.
struct FlowEnclosure {
  enum class Status : std::uint8_t {
    ok,
    blows_up,   ///< no enclosure was found: solutions may escape in finite time, or change too fast
    too_stiff,  ///< the same, and a state decays too fast to be followed so long
    undefined,  ///< the right-hand side is not defined at a state that may be reached
  };
  Status status = Status::ok;
  std::size_t culprit = 0;     ///< index of the equation at fault, unless ok
  double rate = 0.0;           ///< if too stiff: the fastest decay, one over time
  std::vector<Interval> end;   ///< states reachable at tau; unless ok: at the time up to which all is known
  std::vector<Interval> tube;  ///< states reachable in [0, tau], or up to that time
  /// x(t) - x(0) during that time, 0 included; an end is 0 exactly where f never points that way. For the
  /// rounding of the initial box alone widens `tube`.
  std::vector<Interval> drift;
  std::vector<Interval> undefined_at;  ///< if undefined: the slots over which the right-hand side is so
  /// Hull of where solutions that were followed are at tau, so that `end` cannot be smaller than that; empty:
  /// none were.
  std::vector<Interval> reached;
  /// Index of the state of whose initial box the least is known what it leads to; any other number: unknown.
  std::size_t loosest = 0;
  bool in_long_steps = false;  ///< so that short ones may lead to less
};

/// Guaranteed enclosures of the states that a differential equation reaches after tau, for every initial
/// state of a box, every constant value of the other slots and every measurable disturbance in its box.
///
/// 1. A-priori boxes of the solutions by Picard iteration, sub-steps halved until one is found
/// (a_priori.hpp).
/// 2. Over them an interval Jacobian J, so that the difference e of two solutions obeys e' = A(t) e + B(t) v
///    with A, B in J (also where f is only Lipschitz), and bounds of all its transition matrices
///    (sensitivity.hpp); discontinuities count as additional disturbances (dual.hpp). For a part of a line
///    whose end is a summand (FlowSystem), also Taylor series of e' = J(x) e where there is neither
///    (TangentStep): then longer steps are enough.
/// 3. A state that depends on an initial value or a disturbance with a proven sign has its extremes at an end
///    of it. Solutions from those corners are enclosed (Taylor steps with Lagrange's remainder); for the
///    variables without a proven sign they start in the middle, and the mean value theorem adds the rest.
///    Hence the exact hull up to rounding for affine and for monotone systems.
/// 4. Where that leaves much more than the solutions followed have reached, or finds nothing, bounds of each
///    state by its derivative on the faces of the box (face_flow.hpp); the result is in both.
///
/// Over-approximates always. Not thread-safe, as it holds its scratch memory: use a copy a thread.
class ValidatedFlow {
 public:
  /// The period tau lies in [tau_lower, tau_upper], 0 < tau_lower. @pre unchecked: the equations outlive this
  /// object.
  ValidatedFlow(FlowSystem system, double tau_lower, double tau_upper);
  ~ValidatedFlow();
  ValidatedFlow(const ValidatedFlow& other);
  ValidatedFlow& operator=(const ValidatedFlow& other);
  ValidatedFlow(ValidatedFlow&&) noexcept;
  ValidatedFlow& operator=(ValidatedFlow&&) noexcept;

  /// @param slots bounded boxes of all states, disturbances, inputs and parameters at their slots
  /// @returns a reference that is valid until the next call
  [[nodiscard]] const FlowEnclosure& flow(std::span<const Interval> slots);
  /// flow() for a subbox of one that the caller divides further where that pays: with less work.
  /// @param long_steps by tangents, if it is part of a line: still less work, but the result may be wider
  [[nodiscard]] const FlowEnclosure& flow_of_subbox(std::span<const Interval> slots, bool long_steps);

  /// Whether no two solutions can meet within `box`, one interval a state: f is defined and has a Lipschitz
  /// constant on it and a little beyond, and nothing stops there. For the slots of the last flow().
  [[nodiscard]] bool keeps_apart(std::span<const Interval> box);

  /// The work since this object was made that the number of steps of a box does not limit: steps by faces,
  /// and sub-steps along solutions; in such sub-steps.
  [[nodiscard]] std::int64_t extra_steps() const;
  /// All work since then: the sub-steps that were tried, and extra_steps().
  [[nodiscard]] std::int64_t steps() const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace coordreq

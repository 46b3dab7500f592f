#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reach/a_priori.hpp"
#include "reach/taylor_step.hpp"

namespace coordreq {

/// The effect of `stop` on a state during a step, judged by boxes.
enum class StopPhase : std::uint8_t {
  free,  ///< the limit is not felt: never passed, or f does not point out of it
  held,  ///< exactly at the limit, with f pointing out all the time
  open,  ///< neither can be shown
};

/// One solution under constant disturbances, enclosed, with sub-steps of its own: for what a single Taylor
/// step cannot do, as kinks within it, and states that run into a limit. Such events are located by
/// bisection and crossed in a tiny step of first order. Scratch memory for one thread.
class NominalFlow {
 public:
  struct State {
    std::vector<Interval> value;
    std::vector<bool> at_limit;  ///< the state is at one of its limits, not just near it
  };

  /// @pre unchecked: `tape` and `field` outlive it.
  NominalFlow(const FlowTape& tape, VectorField& field);

  /// Moves `state` on by `duration`. @returns false if no enclosure was found.
  /// @param tolerance what a sub-step's remainder may add, a state
  /// @pre unchecked: the field's slots hold the disturbances; discontinuities decided or pinned in `choices`.
  bool advance(const Interval& duration, const Choices& choices, std::span<const double> tolerance,
               State& state);

  /// Sub-steps that were tried so far.
  [[nodiscard]] std::int64_t tries() const { return tries_; }

 private:
  bool try_step(const Interval& duration, bool smallest, std::span<const double> tolerance, State& state);
  bool find_phases(const Interval& duration, const State& state);
  void cross(const Interval& duration, State& state);
  void release(State& state);

  VectorField* field_;
  const FlowTape* tape_;
  TaylorStep taylor_;
  TaylorRemainder remainder_;
  Choices choices_;
  std::vector<Interval> box_;
  std::vector<Interval> derivative_;
  std::vector<StopPhase> phases_;
  std::vector<bool> held_;
  std::vector<double> tolerance_;
  std::int64_t tries_ = 0;
};

/// @param derivative f over `box`, which holds the solutions from `start` for `duration`
[[nodiscard]] bool is_free(const FlowSystem::Limit& limit, const Interval& start, const Interval& derivative,
                           const Interval& duration);

}  // namespace coordreq

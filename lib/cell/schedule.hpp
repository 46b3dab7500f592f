#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>

#include "answers/step_codes.hpp"
#include "cell/action_choice.hpp"

namespace coordreq {

/// The countdown of agents that stay silent for as long as they can (paper, Definition 3), from a cell of K
/// that tolerates so many steps of silence: none if they would connect too late.
[[nodiscard]] inline std::int32_t countdown_from(std::int32_t steps, std::int64_t connection_delay) {
  return steps >= connection_delay || steps == kUnbounded ? steps : 0;
}

/// What is left of it after a silent step.
[[nodiscard]] inline std::int32_t one_less(std::int32_t steps) {
  return steps == kUnbounded ? steps : std::max(steps - 1, 0);
}

/// Who is connected from step to step of a run, which policy the agents go by, and what is promised of it.
/// Each function is given the trace so far. One object a thread.
class Schedule {
 public:
  Schedule() = default;
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;
  virtual ~Schedule() = default;

  /// The first sample of a run, with the stream of what is lost in it; and the sample after a step.
  /// @returns RunTrace::Sample::countdown
  [[nodiscard]] virtual std::int32_t begin(const RunTrace& trace, RandomStream losses) = 0;
  [[nodiscard]] virtual std::int32_t arrive(const RunTrace& trace) = 0;

  /// What agents go by in the step from the last sample, and who chooses by it.
  struct Turn {
    ActionChooser& chooser;
    ActionChooser::Turn policy;
  };
  [[nodiscard]] virtual Turn turn(const RunTrace& trace) = 0;

  /// How a run ends whose agents have no action, or chose what `allow` forbids.
  [[nodiscard]] virtual Outcome stopped(const RunTrace& /*trace*/, bool is_forbidden) const {
    return is_forbidden ? Outcome::not_allowed : Outcome::no_action;
  }
  /// How it ends if it may not go on from the last sample.
  [[nodiscard]] virtual std::optional<Outcome> fault(const RunTrace& trace) const {
    return trace.samples.back().delay < 0 ? std::optional(Outcome::left_invariant) : std::nullopt;
  }
};

/// The agents of a loop: silent as long as they can; on a network that loses steps; or those who follow
/// rules (LoopProblem). @param silent_steps of the last: those without a connection
/// @pre unchecked: `dynamics` and `controller` outlive the object, as what `problem` points to
[[nodiscard]] std::unique_ptr<Schedule> make_schedule(const LoopProblem& problem, Policy policy,
                                                      std::int64_t silent_steps, PointDynamics& dynamics,
                                                      KeptInputs& controller);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "answers/countdown/delay_layers.hpp"
#include "cell/action_choice.hpp"

namespace coordreq {

/// The choice of disturbances and measurement errors from period to period.
enum class Disturbance : std::uint8_t {
  random,    ///< uniform in their ranges
  extremes,  ///< at one end or the other of their ranges, with equal chances
  constant,  ///< given values; nothing is measured wrongly
};

struct LoopOptions {
  std::int64_t steps = 0;
  Policy policy = Policy::random;
  Disturbance disturbance = Disturbance::random;
  std::vector<Rational> constant_disturbance;  ///< one a disturbance; used if constant
  std::uint64_t seed = 1;
  bool until_goal = false;  ///< a run ends where it reaches the goal, as it does if the spec says so
  /// Agents do what they are told, for so many steps (kUnbounded: until S is left), and then what comes
  /// after. Then the second policy is that of silence, and the third one, if there is one, that of what comes
  /// after.
  std::optional<std::int64_t> silent_steps;
};

enum class Outcome : std::uint8_t {
  completed,       ///< all steps, in K all the time
  left_safely,     ///< ended early beyond a `safe` side of the domain
  left_invariant,  ///< ended early because the measured cell is not in K
  no_action,       ///< ended early in K where no action is admissible
  reached_goal,    ///< ended in the goal, as was asked or as the spec says
  late,            ///< more steps than promised, and not in the goal
  not_allowed,     ///< ended early in K where silent agents together do what `allow` forbids
  not_followed,    ///< ended early because the next state could not be worked out
  // Outcomes of agents who follow the rules of `silence`:
  left_safe_set,  ///< ended early outside of S, later than promised
  stuck,          ///< ended early, later than promised, because they could not go on as they are told
  broke_promise,  ///< either of these, earlier
};
/// Whether an outcome contradicts the analysis.
[[nodiscard]] constexpr bool is_violation(Outcome outcome) {
  return outcome == Outcome::left_invariant || outcome == Outcome::no_action || outcome == Outcome::late ||
         outcome == Outcome::not_allowed || outcome == Outcome::broke_promise;
}

/// One run. A sample is a state at a sampling instant; sample k is followed by step k, the last by none.
struct RunTrace {
  struct Sample {
    std::vector<double> state;     ///< the true one
    std::vector<double> measured;  ///< its cell is what agents know
    double margin = 0;             ///< of `safe` at the true state, see Margin
    /// Delay of the cell in steps, as LoopProblem has it; kUnbounded in T, kOutsideSafe beyond an unsafe
    /// side.
    std::int32_t delay = 0;
    std::int32_t arrival = 0;  ///< those to the aim likewise, if there is one; 0 beyond a `goal` side
    bool in_goal = false;      ///< of a lasting goal: the condition holds, or the cell says so
    /// i of Definition 3: steps that the agents still go on without coordination. kUnbounded where they never
    /// need any.
    std::int32_t countdown = 0;
  };
  struct Step {
    std::int64_t input = 0;  ///< number of the joint input
    bool coordinated = false;
    std::vector<double> disturbance;
  };
  std::vector<Sample> samples;  ///< at least one
  std::vector<Step> steps;      ///< one fewer
  Outcome outcome = Outcome::completed;
  std::optional<std::int64_t> arrived;  ///< the sample at which the aim is reached first
  double followed = 0.0;                ///< not_followed: the share of a further step that could be

  [[nodiscard]] std::int64_t coordinated_steps() const;
  /// The most steps in a row without coordination.
  [[nodiscard]] std::int64_t longest_silence() const;
  /// Of a lasting goal: the samples outside it.
  [[nodiscard]] std::int64_t outside_goal() const;
  [[nodiscard]] std::optional<std::int64_t> last_outside_goal() const;
  /// The most steps between two visits that follow each other; nothing if there are not two.
  [[nodiscard]] std::optional<std::int64_t> longest_gap() const;
  /// The smallest margin of the samples, without one that has left safely; infinity if there is none.
  [[nodiscard]] double smallest_margin() const;
};

/// The self-triggered closed loop on the system itself (paper, Definition 3), measured into cells [a, b).
///
/// At a start in x, and after each coordinated step into x: if delay(x) >= D the connection is dropped and a
/// countdown of delay(x) begins. While it is above 0 the agents act from IND_C, and start to connect when it
/// is D; at 0 they coordinate: they act from C. If delay(x) < D the connection stays and the next step is
/// coordinated too. Cells of unbounded delay never coordinate again.
///
/// That is the policy of the delays. Where a countdown begins in a cell in which another policy holds, it is
/// that one's, and so is what the agents act from. If it has an aim, it is followed until that is reached;
/// a run that begins with it is there within the steps that its start has. (On the way to a goal, contract,
/// section 5: approach delay, P and IND_P, within arrival(start) steps.) An aim that lasts, of a goal to stay
/// at or to return to, is followed for ever; what its policy promises of each step is looked at (section 11).
///
/// On a network that loses steps (LoopProblem::network) agents act by the mode of each step: from C if all
/// are connected, else from IND_C of those that are. A run that leaves K is no contradiction then.
/// A policy whose countdown follows from what was agreed, not from the cell that is next, begins with a
/// coordinated step. (Of agents who see only themselves, contract, section 8.)
///
/// A run that reaches a goal which ends the task ends there, whatever agents go by.
///
/// Agents who do what they are told while they are silent (LoopOptions::silent_steps, contract, section 9)
/// have the promise that S holds at the first silence(start) samples; and at all of them, if no more steps
/// than that are silent. What happens later is no contradiction.
///
/// Holds the scratch memory of a run: one object a thread.
class ClosedLoop {
 public:
  ClosedLoop(const LoopProblem& problem, const LoopOptions& options);

  /// @param measured the state as first measured; the true one is off by a measurement error
  /// @param run number of the run: the random streams depend on it, the seed and nothing else
  /// @pre the cell of `measured` is in K; of agents who do what they are told, in theirs
  [[nodiscard]] RunTrace run(std::vector<Rational> measured, std::uint64_t run);

 private:
  struct State {
    std::vector<Rational> exact;
    std::vector<Rational> measured;
    NextStates::Place place;
  };

  [[nodiscard]] bool is_in_k(const std::vector<Rational>& measured) const;
  [[nodiscard]] RunTrace run_lossy(std::vector<Rational> measured, std::uint64_t run);
  [[nodiscard]] RunTrace run_silent(std::vector<Rational> measured, std::uint64_t run);
  [[nodiscard]] std::vector<std::shared_ptr<ActionChooser>> choosers_of_modes();
  [[nodiscard]] Nature draw_nature(RandomStream& random) const;
  [[nodiscard]] State first_state(std::vector<Rational> measured, const Nature& nature) const;
  /// @returns whether the next state is known
  [[nodiscard]] bool advance(State& state, std::int64_t u, const Nature& nature);
  [[nodiscard]] RunTrace::Sample sample(const State& state);
  RunTrace::Sample& add_sample(const State& state, RunTrace& trace);
  /// It has come to a goal in which runs end.
  [[nodiscard]] bool is_at_end(const RunTrace& trace) const { return ends_in_goal_ && trace.arrived; }
  [[nodiscard]] std::int32_t reset_countdown(std::int32_t delay) const;
  /// The place of the policy that is followed from a sample on.
  [[nodiscard]] std::size_t policy_at(const State& state, const RunTrace& trace);
  /// Its countdown.
  [[nodiscard]] std::int32_t begin_countdown(std::size_t policy, const State& state,
                                             const RunTrace& trace) const;
  [[nodiscard]] bool has_aim(std::size_t policy) const { return !problem_.policies[policy].aim.path.empty(); }
  /// Nothing more follows from its aim.
  [[nodiscard]] bool is_through(std::size_t policy, const RunTrace& trace) const {
    return has_aim(policy) && !problem_.policies[policy].aim.lasts && trace.arrived;
  }
  [[nodiscard]] bool is_step_of_aim(const RunTrace& trace) const;
  [[nodiscard]] bool is_beyond_goal_side(const State& state) const;

  LoopProblem problem_;
  LoopOptions options_;
  PointDynamics dynamics_;
  KeptInputs controller_;
  ActionChooser chooser_;
  NextStates next_;
  Margin margin_;
  std::optional<Margin> goal_;  ///< one that lasts
  std::vector<Rational> slots_;
  std::span<const std::int32_t> delay_;
  std::span<const std::int32_t> to_aim_;                       ///< [cells] steps; empty: there is no aim
  bool ends_in_goal_;                                          ///< runs do
  std::vector<std::shared_ptr<ActionChooser>> mode_choosers_;  ///< [mode] of a network that loses steps
};

}  // namespace coordreq

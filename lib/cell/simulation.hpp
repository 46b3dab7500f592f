#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/countdown/kinds.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// How agents choose among the actions that are open to them.
enum class Policy : std::uint8_t {
  random,       ///< uniformly
  adversarial,  ///< together, for the worst next cell
  prefer,       ///< what their `prefer` likes best
};
/// The choice of disturbances and measurement errors from period to period.
enum class Disturbance : std::uint8_t {
  random,    ///< uniform in their ranges
  extremes,  ///< at one end or the other of their ranges, with equal chances
  constant,  ///< given values; nothing is measured wrongly
};
/// "random", "adversarial", "prefer"; "random", "extremes", "constant".
[[nodiscard]] std::string policy_name(Policy policy);
[[nodiscard]] std::string disturbance_name(Disturbance disturbance);

using NamedValues = std::vector<std::pair<std::string, Rational>>;

/// What the closed loop does, whichever answers it follows.
struct LoopOptions {
  std::int64_t steps = 0;
  Policy policy = Policy::random;
  Disturbance disturbance = Disturbance::random;
  std::vector<Rational> constant_disturbance;  ///< one value per disturbance; used if constant
  std::uint64_t seed = 1;
  std::int64_t runs = 1;
  bool until_goal = false;  ///< a run ends where it reaches the goal, as it does if the spec says so
  /// Agents under the communication-loss rule are silent for this many steps, and then follow the fallback
  /// rule; none: they are silent until S is left.
  std::optional<std::int64_t> silent_steps = {};
  /// The measured state that every run starts from; none: uniform over K, drawn for each run.
  std::optional<std::vector<Rational>> start = {};
};

/// LoopOptions with what is resolved by a results file: simulate() sets `start` and `constant_disturbance`
/// from the values given here.
struct SimulationOptions : LoopOptions {
  std::optional<std::string> from;      ///< start as parse_state() reads it; none: uniform over K
  NamedValues disturbance_values;       ///< if constant; those not named are in the middle of their ranges
  std::string partition;                ///< given or canonical name; empty: the only one
  bool is_lossy = false;                ///< steps are lost with the probabilities of the network
  const CountdownKind* kind = nullptr;  ///< the policy that agents follow on request; null: none
  std::optional<std::string> output;    ///< path of the file of runs
  /// Called with the name of each stage when it begins: "checking", "running", "writing"; there are temporary
  /// files in all but "running". May be empty.
  std::function<void(const std::string& stage)> entered;
};

enum class Outcome : std::uint8_t {
  completed,       ///< all steps, in K all the time
  left_safely,     ///< ended early beyond a `safe` side of the domain
  left_invariant,  ///< ended early because the measured cell is not in K
  no_action,       ///< ended early in K where no action is admissible
  reached_goal,    ///< ended in the goal, as was asked or as the spec says
  late,            ///< more steps than promised, and not in the goal
  not_allowed,     ///< ended early in K where silent agents together do what `allow` forbids
  not_followed,    ///< ended early because the next state could not be computed
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
/// "completed", "left_safely", "left_invariant", "no_action", "reached_goal", "late", "not_followed", ...
[[nodiscard]] std::string outcome_name(Outcome outcome);
/// All that runs of a spec can come to.
[[nodiscard]] std::vector<Outcome> outcomes(const ProblemSpec& spec);

/// One run. A sample is a state at a sampling instant; sample k is followed by step k, the last by none.
struct RunTrace {
  struct Sample {
    std::vector<double> state;     ///< the true one
    std::vector<double> measured;  ///< its cell is what agents know
    std::int64_t cell = -1;        ///< that one; -1: none
    double margin = 0;             ///< of `safe` at the true state, see Margin
    /// Delay of the cell in steps, as the results file has it; kUnbounded in T, kOutsideSafe beyond an unsafe
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

/// Runs, and what they say together.
struct Simulation {
  std::string partition;  ///< empty: that of the mode of each step
  std::vector<RunTrace> traces;
  /// Where losses are drawn, of a start that all runs have: what the file says of the probability that such a
  /// run leaves K.
  std::optional<double> risk = {};

  [[nodiscard]] std::int64_t count(Outcome outcome) const;
  /// Over all runs.
  [[nodiscard]] std::int64_t steps() const;
  [[nodiscard]] std::int64_t coordinated_steps() const;
  [[nodiscard]] std::int64_t longest_silence() const;
  [[nodiscard]] double smallest_margin() const;
  /// The first run that contradicts the analysis, or could not be followed to its end. Where losses are drawn
  /// K may be left.
  [[nodiscard]] std::optional<std::size_t> failure() const;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "cell/simulate_runs.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

using NamedValues = std::vector<std::pair<std::string, Rational>>;

struct SimulationOptions {
  std::optional<std::string> start;  ///< as parse_state() reads it; none: uniform over K
  std::string partition;             ///< given or canonical name; empty: the only one
  std::int64_t steps = 0;
  std::int64_t runs = 1;
  Policy policy = Policy::random;
  Disturbance disturbance = Disturbance::random;
  NamedValues constant_disturbance;  ///< those not named are in the middle of their ranges
  std::uint64_t seed = 1;
  bool until_goal = false;  ///< runs end where they reach the goal
  bool is_lossy = false;    ///< steps are lost as the numbers of the network say
  bool blind = false;       ///< silent agents go by what they see themselves
  /// Silent agents do what the spec tells them, for `silent_steps` steps and then what comes after; none: for
  /// ever.
  bool silent = false;
  std::optional<std::int64_t> silent_steps;
  std::optional<std::string> output;  ///< path of the file of runs
  /// Told which stage begins: "checking", "running", "writing"; there are temporary files in all but
  /// "running". May be empty.
  std::function<void(const std::string& stage)> entered;
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

/// "completed", "left_safely", "left_invariant", "no_action", "reached_goal", "late", "not_followed".
[[nodiscard]] std::string outcome_name(Outcome outcome);
/// All that runs of a spec can come to.
[[nodiscard]] std::vector<Outcome> outcomes(const ProblemSpec& spec);
/// "random", "adversarial", "prefer"; "random", "extremes", "constant".
[[nodiscard]] std::string policy_name(Policy policy);
[[nodiscard]] std::string disturbance_name(Disturbance disturbance);

/// The number of the partition with this name, given or canonical; of the only one if `name` is empty.
/// @throws UsageError
[[nodiscard]] std::size_t find_partition(const ProblemSpec& spec, const std::string& name);

/// Memory of simulate_runs(), with all runs kept.
[[nodiscard]] MemoryDemand simulation_demand(const ResultsReader& results, const SimulationOptions& options);
/// Self-triggered closed loops on the system of a results file, from its K, its delays and its abstraction,
/// which is built again unless it is stored. Writes them to `options.output`, also runs that contradict the
/// analysis.
/// @throws UsageError naming the option whose value does not fit the results; SpecError if the spec holds
///   what this version cannot do; ResultsError, IoError
[[nodiscard]] Simulation simulate(const ResultsReader& results, const SimulationOptions& options,
                                  ThreadTeam& team);

}  // namespace coordreq

#include "cell/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <map>

#include "answers/blind/answer.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/one_cell/kept_inputs.hpp"
#include "answers/paths.hpp"
#include "answers/plan.hpp"
#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "cell/cell_controller.hpp"
#include "cell/check_simulation.hpp"
#include "cell/invariant_cells.hpp"
#include "cell/lossy_network.hpp"
#include "cell/risk_values.hpp"
#include "cell/state_text.hpp"
#include "cell/write_runs.hpp"
#include "choices/forbidden_choices.hpp"
#include "model/locate.hpp"
#include "model/sample_reset.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/thread_memory.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

/// The given values, and the middles of the ranges of all others.
std::vector<Rational> constant_disturbance(const ProblemSpec& spec, const NamedValues& given) {
  std::vector<std::string> names;
  std::vector<Rational> result;
  for (const DisturbanceSpec& w : spec.disturbances) {
    names.push_back(w.name);
    result.emplace_back((w.lower + w.upper) / 2);
  }
  if (names.empty() && !given.empty()) {
    throw UsageError("the spec has no disturbances, expected no values", "--disturbance");
  }
  for (const auto& [name, value] : given) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw UsageError(
          fmt::format("unknown disturbance '{}', expected one of {}", name, fmt::join(names, ", ")),
          "--disturbance");
    }
    const auto l = static_cast<std::size_t>(found - names.begin());
    const DisturbanceSpec& w = spec.disturbances[l];
    if (value < w.lower || value > w.upper) {
      throw UsageError(fmt::format("{} = {} is not in its range [{}, {}]", name, to_text(value),
                                   to_text(w.lower), to_text(w.upper)),
                       "--disturbance");
    }
    result[l] = value;
  }
  return result;
}

/// The partition of the delays. Who is connected a network says itself, so that any will do for that.
std::size_t partition_of_loop(const ProblemSpec& spec, const SimulationOptions& options) {
  if (!options.is_lossy) return find_partition(spec, options.partition);
  if (!spec.network || spec.network->probabilities.empty())
    throw UsageError("the spec has no network with probabilities", "--lossy");
  if (!options.partition.empty())
    throw UsageError("the network says who is connected, expected no partition", "--partition");
  return 0;
}

CellSet safe_cells(const UniformGrid& grid, std::span<const std::int32_t> delay) {
  CellSet safe(grid.rows(), grid.row_length());
  for (std::int64_t x = 0; x < grid.cells(); ++x) {
    if (delay[static_cast<std::size_t>(x)] != kOutsideSafe) safe.set(x);
  }
  return safe;
}

/// The policy of the delays, with the one that is asked for, or else all that need not be asked for.
std::vector<AnswerPolicy> loop_policies(const ProblemSpec& spec, const SimulationOptions& options) {
  const std::string asked = options.blind ? "blind" : options.silent ? "silence" : "";
  std::vector<AnswerPolicy> policies = answer_policies(spec);
  const std::string first = policies.front().delay;
  if (options.silent && spec.silence && spec.silence->has_then()) policies.push_back(afterwards_policy());
  std::erase_if(policies, [&](const AnswerPolicy& policy) {
    if (policy.delay == first) return false;
    return policy.delay.empty() ||
           (asked.empty() ? policy.is_on_request : policy.name != asked && policy.name != "afterwards");
  });
  return policies;
}

std::optional<std::int64_t> silent_steps_of(const SimulationOptions& options) {
  if (!options.silent) return std::nullopt;
  return options.silent_steps.value_or(kUnbounded);
}

/// Paths of the fields that a loop reads.
std::vector<std::string> loop_paths(const ProblemSpec& spec, const std::vector<AnswerPolicy>& policies) {
  std::vector<std::string> paths;
  for (const AnswerPolicy& policy : policies) {
    paths.push_back(policy.is_on_request ? policy.countdown() : policy.delay);
    if (!policy.aim.path.empty()) paths.push_back(policy.aim.path);
  }
  // Runs end in such a goal, whatever agents go by.
  const std::string arrival = coordreq::paths::kArrival;
  if (spec.ends_at_goal() && std::ranges::find(paths, arrival) == paths.end()) paths.push_back(arrival);
  return paths;
}

/// Tables that are small beside arrays over cells, for many threads.
class LoadedTables : public ByteTables {
 public:
  /// Loads the tables of one partition.
  LoadedTables(const ResultsReader& results, const PartitionSpec& partition) {
    const ProblemSpec& spec = results.spec();
    for (std::size_t c = 0; c < partition.classes.size(); ++c) {
      if (!has_silent_table(spec, partition, c)) continue;
      const std::string path = paths::silent(spec, partition, c);
      const Field& field = results.field(path);
      Table& table = tables_[path];
      table.bytes = results.bytes(field);
      for (const std::string& axis : field.axes)
        table.shape.push_back(lengths_[axis] = static_cast<std::int64_t>(results.length(axis)));
    }
  }

  [[nodiscard]] std::int64_t length(const std::string& scale) const override { return lengths_.at(scale); }
  [[nodiscard]] std::vector<std::uint8_t> bytes(const std::string& path,
                                                const std::vector<std::int64_t>& place) const override {
    const Table& table = tables_.at(path);
    std::int64_t row = 0;
    for (std::size_t i = 0; i < place.size(); ++i) row = row * table.shape[i] + place[i];
    const auto first = table.bytes.begin() + static_cast<std::ptrdiff_t>(row * table.shape.back());
    return {first, first + static_cast<std::ptrdiff_t>(table.shape.back())};
  }

  /// Bytes of them.
  [[nodiscard]] static double size(const ResultsReader& results) {
    double bytes = 0;
    for (const PartitionSpec& partition : results.spec().coordination.partitions) {
      for (std::size_t c = 0; c < partition.classes.size(); ++c) {
        if (has_silent_table(results.spec(), partition, c))
          bytes += results.elements(results.field(paths::silent(results.spec(), partition, c)));
      }
    }
    return bytes;
  }

 private:
  struct Table {
    std::vector<std::uint8_t> bytes;
    std::vector<std::int64_t> shape;
  };
  std::map<std::string, Table> tables_;
  std::map<std::string, std::int64_t> lengths_;
};

std::vector<std::int32_t> read_cells(const ResultsReader& results, const std::string& path,
                                     std::size_t partition) {
  const Field& field = results.field(path);
  const bool is_of_partitions = field.axes.front() == "/partition";
  return results.values(field, is_of_partitions ? ResultsReader::Leading(partition) : std::nullopt,
                        all_cells(results.grid()));
}

}  // namespace

std::size_t find_partition(const ProblemSpec& spec, const std::string& name) {
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  std::string names;
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    const PartitionSpec& partition = partitions[p];
    if (name.empty() ? partitions.size() == 1 : name == partition.name || name == partition.canonical) {
      return p;
    }
    names += (names.empty() ? "" : ", ") + partition.name;
  }
  throw UsageError(name.empty() ? fmt::format("several partitions, expected the name of one of {}", names)
                                : fmt::format("unknown partition '{}', expected one of {}", name, names),
                   "--partition");
}

MemoryDemand simulation_demand(const ResultsReader& results, const SimulationOptions& options) {
  const ProblemSpec& spec = results.spec();
  const auto cells = static_cast<double>(results.grid().cells());
  const auto states = static_cast<double>(spec.states.size());
  const auto disturbances = static_cast<double>(spec.disturbances.size());
  constexpr double kCopies = 2;  // of an array while it is read
  const auto arrays = static_cast<double>(loop_paths(spec, loop_policies(spec, options)).size());
  double of_cell = (arrays + kCopies) * sizeof(std::int32_t);
  if (spec.controller.file) of_cell += static_cast<double>(PackedPairs::bytes_for(results.inputs().count()));
  if (options.is_lossy) of_cell += bytes_of_risk_values(spec);
  const double sample = sizeof(RunTrace::Sample) + 2 * (16 + 8 * states);
  const double step = sizeof(RunTrace::Step) + (disturbances > 0 ? 16 + 8 * disturbances : 0);
  const double samples = static_cast<double>(options.runs) * (static_cast<double>(options.steps) + 1);
  constexpr double kBytesOfInput = 64;  // what a thread knows of each at a cell
  const double lists =
      1 + (options.is_lossy && spec.network ? static_cast<double>(spec.network->modes.size()) : 0);
  const double of_list =
      std::min(static_cast<double>(KeptInputs::kMostBytes),
               cells * (KeptInputs::kBytesOfList + 8 * static_cast<double>(results.inputs().count())));
  const double tables = options.blind ? LoadedTables::size(results) : 0;
  return {.once = results.reading_bytes() + tables + of_cell * cells + abstraction_bytes(results) +
                  2 * samples * (sample + step),
          .of_thread = kBytesOfPostThread + kBytesOfInput * static_cast<double>(results.inputs().count()) +
                       lists * of_list};
}

Simulation simulate(const ResultsReader& results, const SimulationOptions& options, ThreadTeam& team) {
  const ProblemSpec& spec = results.spec();
  const std::size_t partition = partition_of_loop(spec, options);
  check_options(spec, options);
  RunOptions runs{.loop = {.steps = options.steps,
                           .policy = options.policy,
                           .disturbance = options.disturbance,
                           .constant_disturbance = constant_disturbance(spec, options.constant_disturbance),
                           .seed = options.seed,
                           .until_goal = options.until_goal,
                           .silent_steps = silent_steps_of(options)},
                  .runs = options.runs};
  if (options.start) runs.start = start_state(results, *options.start);
  const auto enter = [&options](const char* stage) {
    if (options.entered) options.entered(stage);
  };
  enter("checking");
  if (options.output) check_writable(*options.output);
  enter("running");
  const std::vector<AnswerPolicy> policies = loop_policies(spec, options);
  const std::vector<std::string> paths = loop_paths(spec, policies);
  std::map<std::string, std::vector<std::int32_t>> values;
  for (const std::string& path : paths) {
    if (!values.contains(path)) values[path] = read_cells(results, path, partition);
  }
  const std::vector<std::int32_t>& delay = values[paths.front()];
  const std::vector<std::int32_t>& start = values[options.silent ? paths::kSilence : paths.front()];
  if (runs.start) {
    check_start(results, *runs.start, start, options.silent);
  } else if (InvariantCells(spec, start).count() == 0) {
    throw UsageError(spec.memory.empty()
                         ? "the invariance set is empty: there is no state to start from"
                         : "the invariance set has no state with an empty memory to start from",
                     "--start");
  }
  // Tubes are not stored.
  const bool is_stored = results.has_abstraction() && !spec.abstraction.between_samples;
  const Abstraction abstraction = is_stored ? results.abstraction() : build_abstraction(spec, team);
  const std::optional<CellSet> beyond =
      safe_beyond_limits(spec, abstraction, safe_cells(results.grid(), delay), team);
  std::optional<PackedPairs> listed;
  if (spec.controller.file) {
    listed = {.inputs = results.inputs().count(),
              .bytes = results.bits(paths::kListed, all_cells(results.grid()))};
  }
  std::optional<LoadedTables> tables;
  if (options.blind) tables.emplace(results, spec.coordination.partitions[partition]);
  LoopProblem problem{.spec = &spec,
                      .abstraction = &abstraction,
                      .partition = &spec.coordination.partitions[partition],
                      .policies = policies,
                      .values = {},
                      .tables = tables ? &*tables : nullptr,
                      .safe_beyond = beyond ? &*beyond : nullptr,
                      .listed = listed ? &*listed : nullptr,
                      .connection_delay = spec.coordination.connection_delay};
  for (const auto& [path, cells] : values) problem.values[path] = cells;
  std::optional<LossyNetwork> network;
  const RiskValues risks = options.is_lossy ? read_risk_values(results) : RiskValues();
  if (options.is_lossy) problem.network = &network.emplace(*spec.network);
  for (const auto& of_mode : risks) problem.mode_values.emplace_back(of_mode.begin(), of_mode.end());
  std::optional<double> risk;
  if (options.is_lossy && spec.risk && runs.start)
    risk = risk_of_runs(results, locate(results.grid(), *runs.start).cell, options.steps);
  Simulation simulation{.partition = options.is_lossy ? "" : problem.partition->name,
                        .traces = simulate_runs(problem, runs, team),
                        .risk = risk};
  if (options.output) {
    enter("writing");
    write_runs(*options.output, results, options, simulation, team);
  }
  return simulation;
}

std::int64_t Simulation::count(Outcome outcome) const {
  return std::count_if(traces.begin(), traces.end(),
                       [outcome](const RunTrace& trace) { return trace.outcome == outcome; });
}

std::int64_t Simulation::steps() const {
  std::int64_t sum = 0;
  for (const RunTrace& trace : traces) sum += static_cast<std::int64_t>(trace.steps.size());
  return sum;
}

std::int64_t Simulation::coordinated_steps() const {
  std::int64_t sum = 0;
  for (const RunTrace& trace : traces) sum += trace.coordinated_steps();
  return sum;
}

std::int64_t Simulation::longest_silence() const {
  std::int64_t longest = 0;
  for (const RunTrace& trace : traces) longest = std::max(longest, trace.longest_silence());
  return longest;
}

double Simulation::smallest_margin() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const RunTrace& trace : traces) smallest = std::min(smallest, trace.smallest_margin());
  return smallest;
}

std::optional<std::size_t> Simulation::failure() const {
  const bool is_lossy = partition.empty();
  const auto found = std::find_if(traces.begin(), traces.end(), [is_lossy](const RunTrace& trace) {
    if (trace.outcome == Outcome::not_followed) return true;
    return is_lossy ? trace.outcome == Outcome::no_action : is_violation(trace.outcome);
  });
  if (found == traces.end()) return std::nullopt;
  return static_cast<std::size_t>(found - traces.begin());
}

std::string outcome_name(Outcome outcome) {
  constexpr const char* kNames[] = {"completed",     "left_safely", "left_invariant", "no_action",
                                    "reached_goal",  "late",        "not_allowed",    "not_followed",
                                    "left_safe_set", "stuck",       "broke_promise"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::vector<Outcome> outcomes(const ProblemSpec& spec) {
  std::vector<Outcome> result;
  const auto add = [&result](bool is_possible, std::initializer_list<Outcome> some) {
    for (const Outcome outcome : some) {
      if (is_possible) result.push_back(outcome);
    }
  };
  add(true, {Outcome::completed, Outcome::left_safely, Outcome::left_invariant, Outcome::no_action,
             Outcome::not_followed});
  add(spec.silence.has_value(), {Outcome::left_safe_set, Outcome::stuck, Outcome::broke_promise});
  add(spec.goal.has_value(), {Outcome::reached_goal, Outcome::late});
  add(may_forbid_choices(spec), {Outcome::not_allowed});
  return result;
}

std::string policy_name(Policy policy) {
  constexpr const char* kNames[] = {"random", "adversarial", "prefer"};
  return kNames[static_cast<std::size_t>(policy)];
}

std::string disturbance_name(Disturbance disturbance) {
  constexpr const char* kNames[] = {"random", "extremes", "constant"};
  return kNames[static_cast<std::size_t>(disturbance)];
}

}  // namespace coordreq

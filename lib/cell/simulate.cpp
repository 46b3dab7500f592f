#include "cell/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "answers/invariance/fields.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/forbidden_choices.hpp"
#include "answers/plan.hpp"
#include "base/error.hpp"
#include "cell/cell_controller.hpp"
#include "cell/invariant_cells.hpp"
#include "cell/state_text.hpp"
#include "cell/write_runs.hpp"
#include "model/locate.hpp"
#include "model/sample_reset.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/thread_memory.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

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

/// No state is beyond a `stop` limit, and none is measured farther than the error from it.
bool is_beyond_limit(const GridDimension& dimension, const Rational& value) {
  const Rational& error = dimension.measurement_error;
  return (dimension.below == Outside::stop && value < dimension.first - error) ||
         (dimension.above == Outside::stop && value > dimension.point(dimension.count - 1) + error);
}

std::vector<Rational> start_state(const ResultsReader& results, const std::string& text) {
  std::vector<Rational> state = parse_state(text, state_names(results.spec()), "--from");
  for (std::size_t i = 0; i < state.size(); ++i) {
    const GridDimension& dimension = results.grid()[i];
    if (dimension.periodic()) state[i] = reset_at_sample(dimension, state[i]);
  }
  return state;
}

void check_start(const ResultsReader& results, const std::vector<Rational>& state,
                 std::span<const std::int32_t> delay) {
  const Location location = locate(results.grid(), state);
  std::optional<std::size_t> fault;
  if (location.kind != Location::Kind::cell) fault = location.dimension;
  for (std::size_t i = 0; i < state.size() && !fault; ++i) {
    if (is_beyond_limit(results.grid()[i], state[i])) fault = i;
  }
  if (fault) {
    const bool off_grid = location.kind == Location::Kind::off_grid;
    throw UsageError(fmt::format("{} = {} is {}", results.grid()[*fault].name, to_text(state[*fault]),
                                 off_grid ? "not a value of this discrete state" : "outside of the domain"),
                     "--from");
  }
  const std::int32_t steps = delay[static_cast<std::size_t>(location.cell)];
  if (steps < 0) {
    throw UsageError(steps == DelayLayers::kOutsideSafe
                         ? "the start is not in the safe set"
                         : "the start is not in the invariance set: on this grid not even coordination keeps "
                           "the system safe from there",
                     "--from");
  }
}

void check_prefer(const ProblemSpec& spec, Policy policy) {
  const auto has_prefer = [](const AgentSpec& agent) { return agent.prefer.has_value(); };
  if (policy != Policy::prefer || std::any_of(spec.agents.begin(), spec.agents.end(), has_prefer)) return;
  throw UsageError("no agent of the spec has a 'prefer'", "--policy");
}

CellSet safe_cells(const UniformGrid& grid, std::span<const std::int32_t> delay) {
  CellSet safe(grid.rows(), grid.row_length());
  for (std::int64_t x = 0; x < grid.cells(); ++x) {
    if (delay[static_cast<std::size_t>(x)] != DelayLayers::kOutsideSafe) safe.set(x);
  }
  return safe;
}

std::vector<AnswerPolicy> loop_policies(const ProblemSpec& spec) {
  std::vector<AnswerPolicy> policies = answer_policies(spec);
  std::erase_if(policies, [](const AnswerPolicy& policy) { return policy.delay.empty(); });
  return policies;
}

/// Of the fields that a loop looks at.
std::vector<std::string> loop_paths(const std::vector<AnswerPolicy>& policies) {
  std::vector<std::string> paths;
  for (const AnswerPolicy& policy : policies) {
    paths.push_back(policy.delay);
    if (!policy.aim.path.empty()) paths.push_back(policy.aim.path);
  }
  return paths;
}

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
  const auto arrays = static_cast<double>(loop_paths(loop_policies(spec)).size());
  double of_cell = (arrays + kCopies) * sizeof(std::int32_t);
  if (spec.controller.file) of_cell += static_cast<double>(PackedPairs::bytes_for(results.inputs().count()));
  const double sample = sizeof(RunTrace::Sample) + 2 * (16 + 8 * states);
  const double step = sizeof(RunTrace::Step) + (disturbances > 0 ? 16 + 8 * disturbances : 0);
  const double samples = static_cast<double>(options.runs) * (static_cast<double>(options.steps) + 1);
  constexpr double kBytesOfInput = 64;  // what a thread knows of each at a cell
  return {.once = results.reading_bytes() + of_cell * cells + abstraction_bytes(results) +
                  2 * samples * (sample + step),
          .of_thread = kBytesOfPostThread + kBytesOfInput * static_cast<double>(results.inputs().count())};
}

Simulation simulate(const ResultsReader& results, const SimulationOptions& options, ThreadTeam& team) {
  const ProblemSpec& spec = results.spec();
  const std::size_t partition = find_partition(spec, options.partition);
  check_prefer(spec, options.policy);
  if (options.until_goal && !spec.goal) throw UsageError("the spec has no goal", "--until");
  RunOptions runs{.loop = {.steps = options.steps,
                           .policy = options.policy,
                           .disturbance = options.disturbance,
                           .constant_disturbance = constant_disturbance(spec, options.constant_disturbance),
                           .seed = options.seed,
                           .until_goal = options.until_goal},
                  .runs = options.runs};
  if (options.start) runs.start = start_state(results, *options.start);
  const auto enter = [&options](const char* stage) {
    if (options.entered) options.entered(stage);
  };
  enter("checking");
  if (options.output) check_writable(*options.output);
  enter("running");
  const std::vector<AnswerPolicy> policies = loop_policies(spec);
  const std::vector<std::string> paths = loop_paths(policies);
  std::map<std::string, std::vector<std::int32_t>> values;
  const std::vector<std::int32_t>& delay = values[paths.front()] =
      read_cells(results, paths.front(), partition);
  if (runs.start) {
    check_start(results, *runs.start, delay);
  } else if (InvariantCells(spec, delay).count() == 0) {
    throw UsageError(spec.memory.empty()
                         ? "the invariance set is empty: there is no state to start from"
                         : "the invariance set has no state with nothing remembered to start from",
                     "--start");
  }
  for (const std::string& path : paths) {
    if (!values.contains(path)) values[path] = read_cells(results, path, partition);
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
  LoopProblem problem{.spec = &spec,
                      .abstraction = &abstraction,
                      .partition = &spec.coordination.partitions[partition],
                      .policies = policies,
                      .values = {},
                      .safe_beyond = beyond ? &*beyond : nullptr,
                      .listed = listed ? &*listed : nullptr,
                      .connection_delay = spec.coordination.connection_delay};
  for (const auto& [path, cells] : values) problem.values[path] = cells;
  Simulation simulation{.partition = problem.partition->name, .traces = simulate_runs(problem, runs, team)};
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
  const auto found = std::find_if(traces.begin(), traces.end(), [](const RunTrace& trace) {
    return is_violation(trace.outcome) || trace.outcome == Outcome::not_followed;
  });
  if (found == traces.end()) return std::nullopt;
  return static_cast<std::size_t>(found - traces.begin());
}

std::string outcome_name(Outcome outcome) {
  constexpr const char* kNames[] = {"completed",    "left_safely", "left_invariant", "no_action",
                                    "reached_goal", "late",        "not_allowed",    "not_followed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::vector<Outcome> outcomes(const ProblemSpec& spec) {
  std::vector<Outcome> result = {Outcome::completed, Outcome::left_safely, Outcome::left_invariant,
                                 Outcome::no_action, Outcome::not_followed};
  if (spec.goal) result.insert(result.end(), {Outcome::reached_goal, Outcome::late});
  if (allow_joins_agents(spec)) result.push_back(Outcome::not_allowed);
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

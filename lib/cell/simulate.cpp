#include "cell/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "answers/invariance/safe_tubes.hpp"
#include "answers/one_cell/kept_inputs.hpp"
#include "answers/paths.hpp"
#include "answers/plan.hpp"
#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "cell/cell_controller.hpp"
#include "cell/check_simulation.hpp"
#include "cell/closed_loop.hpp"
#include "cell/lossy_network.hpp"
#include "cell/risk_values.hpp"
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

/// The policy of the delays, with the one that is requested, or else all that need no request.
std::vector<AnswerPolicy> loop_policies(const ProblemSpec& spec, const SimulationOptions& options) {
  std::vector<AnswerPolicy> policies = answer_policies(spec);
  std::erase_if(policies, [&, first = policies.front().delay](const AnswerPolicy& policy) {
    const bool is_left = options.kind == nullptr ? policy.is_on_request() : policy.kind != options.kind;
    return policy.delay != first && (policy.delay.empty() || is_left);
  });
  return policies;
}

/// Paths of the fields that a loop reads.
std::vector<std::string> loop_paths(const ProblemSpec& spec, const std::vector<AnswerPolicy>& policies) {
  std::vector<std::string> paths;
  const auto add = [&paths](const std::string& path) {
    if (!path.empty() && std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
  };
  for (const AnswerPolicy& policy : policies) {
    add(policy.is_on_request() ? policy.countdown() : policy.delay);
    add(policy.aim.path);
  }
  // Runs end in such a goal, whatever agents go by.
  for (const AnswerPolicy& policy : answer_policies(spec)) {
    if (spec.ends_at_goal()) add(policy.aim.path);
  }
  return paths;
}

/// Tables that are small beside arrays over cells, for many threads.
class LoadedTables : public ByteTables {
 public:
  /// Loads those that policies read in a partition.
  LoadedTables(const ResultsReader& results, const std::vector<AnswerPolicy>& policies,
               const PartitionSpec& partition) {
    for (const std::string& path : paths_of(results.spec(), policies, partition)) {
      const Field& field = results.field(path);
      Table& table = tables_[path];
      table.bytes = results.bytes(field);
      for (const std::string& axis : field.axes)
        table.shape.push_back(lengths_[axis] = static_cast<std::int64_t>(results.length(axis)));
    }
  }

  [[nodiscard]] std::int64_t length(const std::string& scale) const override { return lengths_.at(scale); }
  [[nodiscard]] std::vector<std::uint8_t> bytes(const std::string& path,
                                                const std::vector<std::int64_t>& indices) const override {
    const Table& table = tables_.at(path);
    std::int64_t row = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) row = row * table.shape[i] + indices[i];
    const auto first = table.bytes.begin() + static_cast<std::ptrdiff_t>(row * table.shape.back());
    return {first, first + static_cast<std::ptrdiff_t>(table.shape.back())};
  }

  /// Bytes of those of all partitions.
  [[nodiscard]] static double size(const ResultsReader& results, const std::vector<AnswerPolicy>& policies) {
    double bytes = 0;
    for (const PartitionSpec& partition : results.spec().coordination.partitions) {
      for (const std::string& path : paths_of(results.spec(), policies, partition))
        bytes += results.elements(results.field(path));
    }
    return bytes;
  }

 private:
  struct Table {
    std::vector<std::uint8_t> bytes;
    std::vector<std::int64_t> shape;
  };

  [[nodiscard]] static std::vector<std::string> paths_of(const ProblemSpec& spec,
                                                         const std::vector<AnswerPolicy>& policies,
                                                         const PartitionSpec& partition) {
    std::vector<std::string> paths;
    for (const AnswerPolicy& policy : policies) {
      if (policy.tables == nullptr) continue;
      for (std::string& path : policy.tables(spec, partition)) paths.push_back(std::move(path));
    }
    return paths;
  }

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
  const std::vector<AnswerPolicy> policies = loop_policies(spec, options);
  const auto arrays = static_cast<double>(loop_paths(spec, policies).size());
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
  return {.once = results.reading_bytes() + LoadedTables::size(results, policies) + of_cell * cells +
                  abstraction_bytes(results) + 2 * samples * (sample + step),
          .of_thread = kBytesOfPostThread + kBytesOfInput * static_cast<double>(results.inputs().count()) +
                       lists * of_list};
}

Simulation simulate(const ResultsReader& results, const SimulationOptions& options, ThreadTeam& team) {
  const ProblemSpec& spec = results.spec();
  const std::size_t partition = partition_of_loop(spec, options);
  check_options(spec, options);
  LoopOptions loop = options;
  loop.constant_disturbance = constant_disturbance(spec, options.disturbance_values);
  if (options.from) loop.start = start_state(results, *options.from);
  const auto enter = [&options](const char* stage) {
    if (options.entered) options.entered(stage);
  };
  enter("checking");
  if (options.output) check_writable(*options.output);
  enter("running");
  const std::vector<AnswerPolicy> policies = loop_policies(spec, options);
  std::map<std::string, std::vector<std::int32_t>> values;
  for (const std::string& path : loop_paths(spec, policies))
    values[path] = read_cells(results, path, partition);
  LoopProblem problem{.spec = &spec,
                      .partition = &spec.coordination.partitions[partition],
                      .policies = policies,
                      .values = {},
                      .connection_delay = spec.coordination.connection_delay};
  for (const auto& [path, cells] : values) problem.values[path] = cells;
  if (loop.start) {
    check_start(results, *loop.start, problem.start_steps(), options.kind);
  } else if (!has_start(spec, problem.start_steps())) {
    const bool is_rule = options.kind != nullptr && options.kind->option.no_start != nullptr;
    throw UsageError(std::string(is_rule ? "the silence set " : "the invariance set ") +
                         (spec.memory.empty() ? "is empty: there is no state to start from"
                                              : "has no state with an empty memory to start from"),
                     "--start");
  }
  // Tubes are not stored.
  const bool is_stored = results.has_abstraction() && !spec.abstraction.between_samples;
  const Abstraction abstraction = is_stored ? results.abstraction() : build_abstraction(spec, team);
  problem.abstraction = &abstraction;
  const std::optional<CellSet> beyond =
      safe_beyond_limits(spec, abstraction, safe_cells(results.grid(), problem.delay()), team);
  if (beyond) problem.safe_beyond = &*beyond;
  std::optional<PackedPairs> listed;
  if (spec.controller.file) {
    listed = {.inputs = results.inputs().count(),
              .bytes = results.bits(paths::kListed, all_cells(results.grid()))};
  }
  if (listed) problem.listed = &*listed;
  const LoadedTables tables(results, policies, *problem.partition);
  problem.tables = &tables;
  std::optional<LossyNetwork> network;
  const RiskValues risks = options.is_lossy ? read_risk_values(results) : RiskValues();
  if (options.is_lossy) problem.network = &network.emplace(*spec.network);
  for (const auto& of_mode : risks) problem.mode_values.emplace_back(of_mode.begin(), of_mode.end());
  std::optional<double> risk;
  if (options.is_lossy && spec.risk && loop.start)
    risk = risk_of_runs(results, locate(results.grid(), *loop.start).cell, options.steps);
  Simulation simulation{.partition = options.is_lossy ? "" : problem.partition->name,
                        .traces = simulate_runs(problem, loop, team),
                        .risk = risk};
  if (options.output) {
    enter("writing");
    write_runs(*options.output, results, options, simulation, team);
  }
  return simulation;
}

}  // namespace coordreq

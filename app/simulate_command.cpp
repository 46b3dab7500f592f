#include <fmt/format.h>

#include <optional>

#include "app/commands.hpp"
#include "app/files_in_use.hpp"
#include "app/interrupt.hpp"
#include "app/memory_limit.hpp"
#include "app/named_values.hpp"
#include "app/progress_display.hpp"
#include "app/simulate_report.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
namespace {

/// Steps and runs: what an int32 in a file of runs can count.
constexpr std::uint64_t kMost = INT32_MAX - 1;

std::int64_t parse_count(const std::string& text, const std::string& option) {
  return static_cast<std::int64_t>(parse_whole_number(text, 1, kMost, option));
}

Policy parse_policy(const std::string& text) {
  for (const Policy policy : {Policy::random, Policy::adversarial, Policy::prefer}) {
    if (text == policy_name(policy)) return policy;
  }
  throw UsageError(fmt::format("expected random, adversarial or prefer, found '{}'", text), "--policy");
}

void parse_disturbance(const std::string& text, SimulationOptions& options) {
  for (const Disturbance kind : {Disturbance::random, Disturbance::extremes, Disturbance::constant}) {
    if (text != disturbance_name(kind)) continue;
    options.disturbance = kind;
    return;
  }
  if (text.find('=') == std::string::npos) {
    throw UsageError(fmt::format("expected random, extremes, constant or NAME=VALUE,..., found '{}'", text),
                     "--disturbance");
  }
  options.disturbance = Disturbance::constant;
  options.constant_disturbance = parse_named_values(text, "--disturbance");
}

void parse_start(const SimulateArguments& arguments, SimulationOptions& options) {
  if (arguments.from && arguments.start) {
    throw UsageError("expected --from or --start, found both");
  }
  if (arguments.from) {
    options.start = arguments.from;
  } else if (!arguments.start) {
    throw UsageError("no start, expected --from NAME=VALUE,... or --start random");
  } else if (*arguments.start != "random") {
    throw UsageError(fmt::format("expected random, found '{}'", *arguments.start), "--start");
  }
}

SimulationOptions simulation_options(const CommandLine& line) {
  const SimulateArguments& arguments = line.simulate;
  SimulationOptions options;
  parse_start(arguments, options);
  if (!arguments.steps) throw UsageError("no number of steps, expected --steps N");
  options.steps = parse_count(*arguments.steps, "--steps");
  if (arguments.runs) options.runs = parse_count(*arguments.runs, "--runs");
  if (arguments.seed) options.seed = parse_whole_number(*arguments.seed, 0, UINT64_MAX, "--seed");
  if (arguments.policy) options.policy = parse_policy(*arguments.policy);
  if (arguments.disturbance) parse_disturbance(*arguments.disturbance, options);
  options.partition = arguments.partition.value_or("");
  options.output = line.output;
  options.max_memory = line.max_memory ? line.max_memory : available_memory();
  return options;
}

Simulation simulate_with_care(const ResultsReader& results, SimulationOptions& options,
                              const CommandLine& line) {
  ProgressDisplay shown(line.progress, line.quiet);
  Progress progress;
  // A signal waits while there may be a temporary file; without one it ends the program at once.
  std::optional<InterruptDelay> delay;
  options.entered = [&](const std::string& stage) {
    if (is_interrupted()) throw Error(ExitCode::interrupted, "interrupted", "");
    progress = {.stage = stage};
    shown.update(progress);
    if (stage == "running") {
      delay.reset();
    } else if (!delay) {
      delay.emplace();
    }
  };
  ThreadTeam team(line.threads);
  team.set_watch([&](std::int64_t done, std::int64_t all) {
    if (delay && is_interrupted()) throw Error(ExitCode::interrupted, "interrupted", "");
    progress.done = done;
    progress.all = all;
    shown.update(progress);
  });
  Simulation simulation = simulate(results, options, team);
  shown.finish();
  if (is_interrupted()) {
    throw Error(ExitCode::interrupted, "interrupted when the runs were complete",
                options.output.value_or(""));
  }
  return simulation;
}

}  // namespace

ExitCode run_simulate(const CommandLine& line) {
  SimulationOptions options = simulation_options(line);
  if (line.output) check_output(line.path, *line.output, "the runs");
  const ResultsReader results(line.path);
  const Simulation simulation = simulate_with_care(results, options, line);
  if (line.json) {
    write_output(simulation_json(simulation, results, options));
  } else if (!line.quiet) {
    write_output(simulation_text(simulation, results, options));
  }
  return simulation.violation() ? ExitCode::requirement_failed : ExitCode::success;
}

}  // namespace coordreq

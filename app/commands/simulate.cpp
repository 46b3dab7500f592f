#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "app/commands/all.hpp"
#include "app/files_in_use.hpp"
#include "app/interrupt.hpp"
#include "app/option_values.hpp"
#include "app/progress_display.hpp"
#include "app/reports.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Steps and runs: what an int32 in a file of runs can count.
constexpr WholeNumber<std::int64_t> kCount{1, INT32_MAX - 1};

struct SimulateOptions : CommonOptions {
  std::string results;
  bool starts_anywhere = false;
  std::vector<const CountdownKind*> kinds;  ///< requested
  std::optional<std::string> steps, silent_steps;
  SimulationOptions simulation;
  ProgressOptions progress;
};

/// A kind of disturbance, or the values of one that does not vary.
void read_disturbance(SimulationOptions& simulation, const std::string& text, const std::string& option) {
  static const OneOf<Disturbance> kKinds = {{{"random", Disturbance::random},
                                             {"extremes", Disturbance::extremes},
                                             {"constant", Disturbance::constant}},
                                            "NAME=VALUE,..."};
  if (text.find('=') == std::string::npos) {
    simulation.disturbance = kKinds(text, option);
  } else {
    simulation.disturbance = Disturbance::constant;
    simulation.disturbance_values = named_values(text, option);
  }
}

void check_complete(const SimulateOptions& options) {
  if (options.simulation.from && options.starts_anywhere)
    throw UsageError("expected --from or --start, found both");
  if (!options.simulation.from && !options.starts_anywhere)
    throw UsageError("no start, expected --from NAME=VALUE,... or --start random");
  if (options.kinds.size() > 1) {
    const char *const first = options.kinds[0]->option.name, *const second = options.kinds[1]->option.name;
    throw UsageError(fmt::format("expected {} or {}, found both", first, second), second);
  }
  if (!options.steps) throw UsageError("no number of steps, expected --steps N");
}

Simulation simulate_with_care(const ResultsReader& results, SimulationOptions& options,
                              const SimulateOptions& args) {
  const std::string runs = fmt::format("{} runs of {} steps need", options.runs, options.steps);
  ThreadTeam team(args.threads_for(runs, simulation_demand(results, options)));
  ProgressDisplay shown(args.progress, args.quiet);
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

ExitCode run(const SimulateOptions& args) {
  check_complete(args);
  if (args.simulation.output) check_output(args.results, *args.simulation.output, "the runs");
  SimulationOptions options = args.simulation;
  if (!args.kinds.empty()) options.kind = args.kinds.front();
  args.keep_to_memory();
  const ResultsReader results(args.results, args.max_memory);
  const DynamicsSpec& dynamics = results.spec().dynamics;
  options.steps = steps_or_time(args.steps.value(), dynamics, "--steps");
  if (args.silent_steps)
    options.silent_steps = steps_or_time(*args.silent_steps, dynamics, "--silent", {.least = 0});
  const Simulation simulation = simulate_with_care(results, options, args);
  print_simulation(args, simulation, results, options);
  return simulation.failure() ? ExitCode::requirement_failed : ExitCode::success;
}

}  // namespace

Run declare_simulate(Options& options) {
  const auto args = std::make_shared<SimulateOptions>();
  SimulationOptions& simulation = args->simulation;
  declare_results(options, args->results);
  options.option(simulation.from, "--from", "STATE", "State to start from, e.g. x1=0.1,x2=0", as_typed);
  options.option(args->starts_anywhere, "--start", "random", "Start at random states of the invariance set",
                 OneOf<bool>{{{"random", true}}});
  options.option(args->steps, "--steps", "N", "Length of a run: steps, or a time, e.g. 10min", as_typed);
  options.option(simulation.runs, "--runs", "N", "Number of runs (default: 1)", kCount);
  options.option(simulation.seed, "--seed", "N", "Seed of the random numbers (default: 1)",
                 WholeNumber<std::uint64_t>{0, UINT64_MAX});
  options.option(
      simulation.policy, "--policy", "random|adversarial|prefer", "Policy of the agents (default: random)",
      OneOf<Policy>{
          {{"random", Policy::random}, {"adversarial", Policy::adversarial}, {"prefer", Policy::prefer}}});
  options.option(
      "--disturbance", "random|extremes|constant|VALUES",
      "Disturbances (default: random); VALUES are constant, e.g. w1=0.1,w2=0",
      [&simulation](const auto& text, const auto& option) { read_disturbance(simulation, text, option); });
  options.option("--until", "goal", "End runs when they reach the goal",
                 [&simulation](const auto& text, const auto& option) {
                   simulation.until_goal = OneOf<bool>{{{"goal", true}}}(text, option);
                 });
  options.flag(simulation.is_lossy, "--lossy", "Lose steps with the probabilities of the network");
  for (const CountdownKind* const kind : kCountdownKinds) {
    const CountdownOption& option = kind->option;
    if (option.name == nullptr) continue;
    const auto request = [args = args.get(), kind] { args->kinds.push_back(kind); };
    if (!option.takes_steps) {
      options.flag(option.name, option.description, request);
      continue;
    }
    options.option_with_or_without(option.name, "N", option.description,
                                   [args = args.get(), request](const auto& text, const auto& /*option*/) {
                                     request();
                                     if (!text.empty()) args->silent_steps = text;
                                   });
  }
  options.option(simulation.partition, "--partition", "NAME", "Partition (default: the only one)", as_typed);
  options.option(simulation.output, "-o,--output", "FILE", "File for the runs (default: none)", file_name);
  declare_progress(options, args->progress);
  declare_common(options, *args);
  return [args] { return run(*args); };
}

}  // namespace coordreq

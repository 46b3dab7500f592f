#include "app/simulate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/json_text.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

std::string count_of(std::int64_t count, const char* noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

/// Time as steps and, where the spec has a unit, in that unit.
std::string steps_text(std::int64_t steps, const ProblemSpec& spec) {
  return duration(steps, nearest_double(spec.dynamics.period), spec.dynamics.unit);
}

std::string state_text(const std::vector<double>& state, const ProblemSpec& spec) {
  std::string text;
  for (std::size_t i = 0; i < state.size(); ++i) {
    text += fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", spec.states[i].name, state[i]);
  }
  return text;
}

bool is_disturbed(const ProblemSpec& spec) {
  return !spec.disturbances.empty() ||
         std::any_of(spec.states.begin(), spec.states.end(),
                     [](const StateSpec& state) { return state.measurement_error != 0; });
}

std::string heading(const Simulation& simulation, const ProblemSpec& spec, const SimulationOptions& options) {
  std::string text = fmt::format("{}, partition {}: {} of {}, policy {}", spec.name, simulation.partition,
                                 count_of(options.runs, "run"), steps_text(options.steps, spec),
                                 policy_name(options.policy));
  if (is_disturbed(spec)) text += ", disturbance " + disturbance_name(options.disturbance);
  return text + fmt::format(", seed {}\n", options.seed);
}

std::string outcome_text(Outcome outcome) {
  constexpr const char* kTexts[] = {"stayed in the invariance set", "left through a safe side",
                                    "left the invariance set", "found no admissible action"};
  return kTexts[static_cast<std::size_t>(outcome)];
}

std::string outcomes_text(const Simulation& simulation) {
  if (simulation.traces.size() == 1) return outcome_text(simulation.traces.front().outcome);
  std::string text;
  for (const Outcome outcome :
       {Outcome::completed, Outcome::left_safely, Outcome::left_invariant, Outcome::no_action}) {
    const std::int64_t count = simulation.count(outcome);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), outcome_text(outcome));
  }
  return text;
}

std::string coordinated_text(const Simulation& simulation) {
  const std::int64_t steps = simulation.steps();
  const std::int64_t coordinated = simulation.coordinated_steps();
  const double percent =
      steps == 0 ? 0.0 : 100 * static_cast<double>(coordinated) / static_cast<double>(steps);
  return fmt::format("{} of {} ({:.3g} %); a centralised loop coordinates all of them", grouped(coordinated),
                     count_of(steps, "step"), percent);
}

std::string violation_text(const Simulation& simulation, const ProblemSpec& spec) {
  const std::optional<std::size_t> violation = simulation.violation();
  if (!violation) return {};
  const RunTrace& trace = simulation.traces[*violation];
  return fmt::format("\nRun {} {} at step {}, at {}.\nThat contradicts the analysis: please report it.\n",
                     *violation, outcome_text(trace.outcome), grouped(std::uint64_t{trace.steps.size()}),
                     state_text(trace.samples.back().state, spec));
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json state_json(const std::vector<double>& state, const ProblemSpec& spec) {
  Json json;
  for (std::size_t i = 0; i < state.size(); ++i) json[spec.states[i].name] = number(state[i]);
  return json;
}

Json trace_json(const RunTrace& trace, std::size_t run, const ProblemSpec& spec) {
  Json json;
  json["run"] = run;
  json["outcome"] = outcome_name(trace.outcome);
  json["steps"] = trace.steps.size();
  json["coordinated"] = trace.coordinated_steps();
  json["longest_silence"] = trace.longest_silence();
  json["smallest_margin"] = number(trace.smallest_margin());
  json["start"] = state_json(trace.samples.front().state, spec);
  json["end"] = state_json(trace.samples.back().state, spec);
  return json;
}

}  // namespace

std::string simulation_text(const Simulation& simulation, const ResultsReader& results,
                            const SimulationOptions& options) {
  const ProblemSpec& spec = results.spec();
  Table table({Table::Align::left, Table::Align::left});
  table.add({"outcome", outcomes_text(simulation)});
  table.add({"coordinated", coordinated_text(simulation)});
  table.add({"longest silence", steps_text(simulation.longest_silence(), spec)});
  table.add({"smallest margin", fmt::format("{:.6g}", simulation.smallest_margin())});
  if (simulation.traces.size() == 1) {
    table.add({"start", state_text(simulation.traces.front().samples.front().state, spec)});
    table.add({"end", state_text(simulation.traces.front().samples.back().state, spec)});
  }
  std::string text = heading(simulation, spec, options) + table.text() + violation_text(simulation, spec);
  if (options.output) text += fmt::format("\nruns in {}\n", printable(*options.output));
  return text;
}

std::string simulation_json(const Simulation& simulation, const ResultsReader& results,
                            const SimulationOptions& options) {
  const ProblemSpec& spec = results.spec();
  const double period = nearest_double(spec.dynamics.period);
  Json json;
  json["name"] = spec.name;
  json["results"] = results.path();
  json["guarantee"] = results.attributes().guarantee;
  json["partition"] = simulation.partition;
  json["connection_delay"] = spec.coordination.connection_delay;
  json["policy"] = policy_name(options.policy);
  json["disturbance"] = disturbance_name(options.disturbance);
  json["seed"] = options.seed;
  json["runs"] = options.runs;
  json["steps"] = options.steps;
  json["period"] = period;
  json["period_unit"] = spec.dynamics.unit;
  for (const Outcome outcome :
       {Outcome::completed, Outcome::left_safely, Outcome::left_invariant, Outcome::no_action}) {
    json["outcomes"][outcome_name(outcome)] = simulation.count(outcome);
  }
  json["steps_done"] = simulation.steps();
  json["coordinated"] = simulation.coordinated_steps();
  json["longest_silence"] = simulation.longest_silence();
  json["longest_silence_time"] =
      nearest_double(spec.dynamics.period * Rational(static_cast<long>(simulation.longest_silence())));
  json["smallest_margin"] = number(simulation.smallest_margin());
  json["output"] = options.output ? Json(*options.output) : Json();
  json["traces"] = Json::array();
  for (std::size_t r = 0; r < simulation.traces.size(); ++r) {
    json["traces"].push_back(trace_json(simulation.traces[r], r, spec));
  }
  return json_text(json);
}

}  // namespace coordreq

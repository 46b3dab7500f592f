#include "app/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/print.hpp"
#include "app/render.hpp"
#include "app/report_error.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

bool is_disturbed(const ProblemSpec& spec) {
  return !spec.disturbances.empty() ||
         std::any_of(spec.states.begin(), spec.states.end(),
                     [](const StateSpec& state) { return state.measurement_error != 0; });
}

bool is_lossy(const Json& simulation) {
  return simulation.contains("network");
}

/// Who is connected.
std::string connection_text(const Json& simulation) {
  return is_lossy(simulation) ? "losses of network " + text_of(simulation["network"])
                              : "partition " + text_of(simulation["partition"]);
}

std::string heading(const Json& simulation, const ProblemSpec& spec) {
  std::string text = fmt::format("{}, {}: {} of {}, policy {}", text_of(simulation["name"]),
                                 connection_text(simulation), count_of(number_of(simulation["runs"]), "run"),
                                 duration(simulation["steps"], simulation), text_of(simulation["policy"]));
  for (const CountdownKind* const kind : kCountdownKinds) {
    const CountdownOption& option = kind->option;
    if (option.name == nullptr || !simulation.contains(option.key())) continue;
    const Json& steps = simulation[option.key()];
    text += fmt::format(", {}", option.key());
    if (option.takes_steps)
      text += steps.is_null() ? " until the end" : " for " + count_of(number_of(steps), "step");
  }
  if (is_disturbed(spec)) text += ", disturbance " + text_of(simulation["disturbance"]);
  return text + fmt::format(", seed {}\n", simulation["seed"].get<std::uint64_t>());
}

std::string outcome_text(const std::string& outcome) {
  static const std::map<std::string, std::string> kTexts = {
      {"completed", "stayed in the invariance set"},
      {"left_safely", "left through a safe side"},
      {"left_invariant", "left the invariance set"},
      {"no_action", "found no admissible action"},
      {"reached_goal", "reached the goal"},
      {"late", "did not reach the goal in time"},
      {"not_allowed", "did what 'allow' forbids"},
      {"not_followed", "could not be followed"},
      {"left_safe_set", "left the safe set, later than promised"},
      {"stuck", "had no action under the rule, later than promised"},
      {"broke_promise", "left the safe set within the promised silence"}};
  return kTexts.at(outcome);
}

std::string outcomes_text(const Json& simulation) {
  const Json& traces = simulation["traces"];
  // Silent agents may leave K.
  const auto text_of_outcome = [&](const std::string& outcome) {
    const bool is_silent = simulation.contains("silent") && outcome == "completed";
    return is_silent ? "stayed in the safe set" : outcome_text(outcome);
  };
  if (traces.size() == 1) return text_of_outcome(text_of(traces.front()["outcome"]));
  std::string text;
  for (const auto& [outcome, count] : simulation["outcomes"].items()) {
    if (count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), text_of_outcome(outcome));
  }
  return text;
}

std::string coordinated_text(const Json& simulation) {
  const std::int64_t steps = number_of(simulation["steps_done"]);
  const std::int64_t coordinated = number_of(simulation["coordinated"]);
  const double percent =
      steps == 0 ? 0.0 : 100 * static_cast<double>(coordinated) / static_cast<double>(steps);
  return fmt::format("{} of {} ({:.3g} %); a centralised loop coordinates all of them", grouped(coordinated),
                     count_of(steps, "step"), percent);
}

/// The text about the first run that contradicts the analysis. Where losses are drawn the invariance set may
/// be left.
std::string violation_text(const Json& simulation) {
  const Json& traces = simulation["traces"];
  const auto violates = [lossy = is_lossy(simulation)](const Json& trace) {
    if (trace["outcome"] == "no_action") return true;
    return !lossy && (trace["outcome"] == "left_invariant" || trace["outcome"] == "late" ||
                      trace["outcome"] == "not_allowed" || trace["outcome"] == "broke_promise");
  };
  const auto first = std::find_if(traces.begin(), traces.end(), violates);
  if (first == traces.end()) return {};
  return fmt::format("\nRun {} {} at step {}, at {}.\nThat contradicts the analysis: {}.\n",
                     number_of((*first)["run"]), outcome_text(text_of((*first)["outcome"])),
                     grouped((*first)["steps"]), values_text((*first)["end"]), report_request());
}

/// The text about the first run that could not be followed to its end.
std::string not_followed_text(const Json& simulation) {
  for (const Json& trace : simulation["traces"]) {
    if (trace["outcome"] != "not_followed") continue;
    const std::string unit = text_of(simulation["period_unit"]);
    return fmt::format(
        "\nRun {} cannot be followed beyond {:.6g}{}, from {} on: it changes too fast, or an equation is not "
        "defined.\nThat says nothing of the analysis.\n",
        number_of(trace["run"]), trace["followed_until"].get<double>(), unit.empty() ? "" : " " + unit,
        values_text(trace["end"]));
  }
  return {};
}

Json state_json(const std::vector<double>& state, const ProblemSpec& spec) {
  Json json;
  for (std::size_t i = 0; i < state.size(); ++i) json[spec.states[i].name] = state[i];
  return json;
}

Json trace_json(const RunTrace& trace, std::size_t run, const ProblemSpec& spec) {
  Json json{{"run", run},
            {"outcome", outcome_name(trace.outcome)},
            {"steps", trace.steps.size()},
            {"coordinated", trace.coordinated_steps()},
            {"longest_silence", trace.longest_silence()},
            {"smallest_margin", trace.smallest_margin()},
            {"start", state_json(trace.samples.front().state, spec)},
            {"end", state_json(trace.samples.back().state, spec)}};
  const auto or_null = [](std::optional<std::int64_t> steps) { return steps ? Json(*steps) : Json(); };
  if (spec.goal && !spec.is_goal_lasting()) json["arrived"] = or_null(trace.arrived);
  if (spec.goal_then == GoalThen::come_back) json["longest_gap"] = or_null(trace.longest_gap());
  if (spec.goal_then == GoalThen::stay) {
    json["outside_goal"] = trace.outside_goal();
    json["last_outside_goal"] = or_null(trace.last_outside_goal());
  }
  if (trace.outcome == Outcome::not_followed) {
    const double steps = static_cast<double>(trace.steps.size()) + trace.followed;
    json["followed_until"] = steps * nearest_double(spec.dynamics.period);
  }
  return json;
}

/// The number of runs that reach the goal, and the time of the last arrival.
std::string goal_of_runs_text(const Json& simulation) {
  std::int64_t count = 0, latest = 0;
  for (const Json& trace : simulation["traces"]) {
    if (trace["arrived"].is_null()) continue;
    ++count;
    latest = std::max(latest, trace["arrived"].get<std::int64_t>());
  }
  const auto runs = static_cast<std::int64_t>(simulation["traces"].size());
  if (count == 0) return "not reached";
  const std::string when = duration(Json(latest), simulation);
  if (runs == 1) return "reached after " + when;
  return fmt::format("reached by {} of {}, after at most {}", grouped(count), count_of(runs, "run"), when);
}

/// The greatest of a member of all runs; nothing if it is null in all of them.
std::optional<std::int64_t> greatest_of_runs(const Json& simulation, const char* member) {
  std::optional<std::int64_t> greatest;
  for (const Json& trace : simulation["traces"]) {
    if (!trace[member].is_null())
      greatest = std::max(greatest.value_or(0), trace[member].get<std::int64_t>());
  }
  return greatest;
}

/// How often and when last runs are outside the goal, or how long they are between visits.
std::string lasting_goal_text(const Json& simulation, const ProblemSpec& spec) {
  if (spec.goal_then == GoalThen::come_back) {
    const std::optional<std::int64_t> gap = greatest_of_runs(simulation, "longest_gap");
    return gap ? fmt::format("at most {} between two visits", duration(Json(*gap), simulation))
               : "not visited twice";
  }
  const std::optional<std::int64_t> last = greatest_of_runs(simulation, "last_outside_goal");
  if (!last) return "never left";
  return fmt::format("at most {} outside, the last after {}",
                     count_of(*greatest_of_runs(simulation, "outside_goal"), "sample"),
                     duration(Json(*last), simulation));
}

/// How many runs leave the invariance set, and how many of them are to be expected at the most.
std::string left_text(const Json& simulation) {
  const Json& outcomes = simulation["outcomes"];
  std::int64_t count = number_of(outcomes["left_invariant"]);
  if (outcomes.contains("not_allowed")) count += number_of(outcomes["not_allowed"]);
  const std::string text =
      fmt::format("{} of {}", grouped(count), count_of(number_of(simulation["runs"]), "run"));
  const Json& risk = simulation["risk"];
  return risk.is_null() ? text : fmt::format("{}; the risk is at most {}", text, probability_text(risk));
}

/// "0.6, in the units of \"safe\"".
std::string margin_text(double margin, const ProblemSpec& spec) {
  if (std::isinf(margin)) return "none: \"safe\" has no limit";
  const bool is_by_centre = margin < 0 && spec.abstraction.safe == Membership::center;
  return fmt::format(
      "{:.6g}, in the units of \"safe\"{}", margin,
      is_by_centre ? "; only centres of cells are kept safe, states may be half a cell away" : "");
}

std::string simulation_text(const Json& simulation, const ProblemSpec& spec) {
  const Json& traces = simulation["traces"];
  Facts facts = {{"outcome", outcomes_text(simulation)},
                 {"coordinated", coordinated_text(simulation)},
                 {"longest silence", duration(simulation["longest_silence"], simulation)},
                 {"smallest margin", margin_text(simulation["smallest_margin"].get<double>(), spec)}};
  if (is_lossy(simulation)) facts.emplace_back("left", left_text(simulation));
  if (spec.goal)
    facts.emplace_back(
        "goal", spec.is_goal_lasting() ? lasting_goal_text(simulation, spec) : goal_of_runs_text(simulation));
  if (traces.size() == 1) {
    facts.emplace_back("start", values_text(traces.front()["start"]));
    facts.emplace_back("end", values_text(traces.front()["end"]));
  }
  std::string text = heading(simulation, spec) + facts_text(facts) + violation_text(simulation) +
                     not_followed_text(simulation);
  if (!simulation["output"].is_null()) text += fmt::format("\nruns in {}\n", line_of(simulation["output"]));
  return text;
}

// Numbers that are not finite are null where the document is printed.
Json simulation_json(const Simulation& simulation, const ResultsReader& results,
                     const SimulationOptions& options) {
  const ProblemSpec& spec = results.spec();
  Json json;
  json["name"] = spec.name;
  json["results"] = results.path();
  json["guarantee"] = results.attributes().guarantee;
  json["partition"] = simulation.partition.empty() ? Json() : Json(simulation.partition);
  if (simulation.partition.empty()) {
    json["network"] = network_kind_name(spec.network->kind);
    json["risk"] = simulation.risk ? Json(*simulation.risk) : Json();
  }
  json["connection_delay"] = spec.coordination.connection_delay;
  json["policy"] = policy_name(options.policy);
  if (options.kind != nullptr) {
    Json& requested = json[options.kind->option.key()];
    if (!options.kind->option.takes_steps) requested = true;
    if (options.silent_steps) requested = *options.silent_steps;
  }
  json["disturbance"] = disturbance_name(options.disturbance);
  json["seed"] = options.seed;
  json["runs"] = options.runs;
  json["steps"] = options.steps;
  json["period"] = nearest_double(spec.dynamics.period);
  json["period_unit"] = spec.dynamics.unit;
  for (const Outcome outcome : outcomes(spec))
    json["outcomes"][outcome_name(outcome)] = simulation.count(outcome);
  json["steps_done"] = simulation.steps();
  json["coordinated"] = simulation.coordinated_steps();
  json["longest_silence"] = simulation.longest_silence();
  json["longest_silence_time"] =
      nearest_double(spec.dynamics.period * Rational(static_cast<long>(simulation.longest_silence())));
  json["smallest_margin"] = simulation.smallest_margin();
  json["output"] = options.output ? Json(*options.output) : Json();
  json["traces"] = Json::array();
  for (std::size_t r = 0; r < simulation.traces.size(); ++r)
    json["traces"].push_back(trace_json(simulation.traces[r], r, spec));
  return json;
}

}  // namespace

void print_simulation(const CommonOptions& args, const Simulation& simulation, const ResultsReader& results,
                      const SimulationOptions& options) {
  print_answer(args, simulation_json(simulation, results, options),
               [&results](const Json& found) { return simulation_text(found, results.spec()); });
}

}  // namespace coordreq

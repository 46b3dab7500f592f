#include "app/requirement_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/render.hpp"
#include "base/grouped.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"
#include "spec/state_bounds.hpp"

namespace coordreq {
namespace {

const RequirementTraits& traits_of(const Json& entry) {
  return requirement_traits(entry["kind"].get<std::string>());
}

/// The value by which states are judged: "delay", "arrival" or "approach_delay".
std::string value_key(const Json& entry) {
  return traits_of(entry).value;
}

std::string cell_failures(const Json& entry, const ProblemSpec& spec) {
  const Json& found = entry["counterexample"];
  const Json& first = found["steps"].empty() ? found["end_sample"] : found["steps"].front();
  const auto failing = entry["failing"].get<std::int64_t>();
  return fmt::format(
      "{} of {} {}, the worst at {}: it {}", grouped(failing), cells(entry["cells"]),
      failing == 1 ? "fails" : "fail", values_text(found["state"]),
      worst_text(entry["kind"], first[value_key(entry)], first[value_key(entry) + "_status"], spec));
}

/// "p1 above its grid".
std::string side_text(const Json& side) {
  return fmt::format("{} {} its grid", text_of(side["state"]), text_of(side["side"]));
}

std::string value_cell(const Json& sample, const std::string& key) {
  if (sample[key + "_status"] == "unbounded") return "unbounded";
  return sample[key].is_null() ? "-" : grouped(sample[key]);
}

std::string time_cell(const Json& time) {
  return time.is_null() ? "never" : grouped(time);
}

/// A row without its number. @param key what states are judged by; empty: left out
std::vector<std::string> table_row(const Json& sample, const std::string& key, const ProblemSpec& spec) {
  const bool is_step = sample.contains("action");
  std::vector<std::string> row;
  for (const Json& value : sample["state"]) row.push_back(fmt::format("{:.6g}", value.get<double>()));
  if (!key.empty()) row.push_back(value_cell(sample, key));
  row.push_back(time_cell(sample["collision_time"]));
  row.push_back(is_step ? text_of(sample["action"]) : "");
  for (const AgentSpec& agent : spec.agents)
    row.push_back(is_step ? values_text(sample["inputs"][agent.name]) : "");
  return row;
}

/// Texts of requirements about a goal; they differ for a goal to stay at and one to return to.
struct GoalTexts {
  std::string claim, failing, never, arrived, cannot, lost;
};
GoalTexts goal_texts(GoalThen then) {
  if (then == GoalThen::stay) {
    return {.claim = "outside the goal for at most {samples}",
            .failing = "may be outside the goal for {samples}",
            .never = "the state may never stay in the goal",
            .arrived = "the state can stay in the goal, after too many samples outside",
            .cannot = "cannot be made to stay in the goal",
            .lost = "the state has made no progress"};
  }
  if (then == GoalThen::come_back) {
    return {.claim = "at the next visit of the goal after at most {steps}",
            .failing = "takes {steps} to the next visit of the goal",
            .never = "the goal may never be visited again",
            .arrived = "the goal is visited too late",
            .cannot = "cannot be made to visit the goal again and again",
            .lost = "the state has made no progress"};
  }
  const RequirementTraits& usual = requirement_traits("max_arrival");
  return {.claim = usual.claim,
          .failing = usual.failing,
          .never = "the goal may never be reached",
          .arrived = "the goal is reached too late",
          .cannot = "cannot be made to reach the goal",
          .lost = "the state is not nearer to the goal"};
}

std::string end_text(const Json& path, const ProblemSpec& spec) {
  const std::string end = text_of(path["end"]);
  const GoalTexts texts = goal_texts(spec.goal_then);
  if (end == "outside_safe_set") return "the state is no longer safe";
  if (end == "left_domain") return "the state leaves the domain, " + side_text(path["left_side"]);
  if (end == "unsafe_between_samples") return "the motion to the next sample is not safe";
  if (end == "arrived") return texts.arrived;
  if (end == "never_arrives")
    return (path["end_sample"].is_null() ? "the state may have left the domain: " : "the state repeats: ") +
           texts.never;
  if (end == "time_lost") return texts.lost;
  if (end == "not_allowed") return "their joint input is one that 'allow' forbids";
  if (end == "no_common_action")
    return "some class has no action that suits all cells that look the same to it";
  if (end == "outside_silence_set") return "the fallback rule is no longer safe";
  if (end == "no_silent_action") return "the communication-loss rule permits no action for some agent";
  return "no joint input is allowed";
}

/// Agents who follow their rules, up to the state in which coordination cannot help any more.
std::vector<std::string> silent_sentences(const Json& path, const ProblemSpec& spec) {
  std::map<std::string, std::int64_t> count;
  for (const Json& step : path["steps"]) ++count[text_of(step["action"])];
  const std::int64_t later = count["afterwards"] + count["evasive"];
  const std::string end = end_text(path, spec);
  if (later == 0)
    return {fmt::format("The agents follow the communication-loss rule, and after {} {}.",
                        steps_text(count["silent"], spec), end)};
  std::vector<std::string> sentences;
  if (count["silent"] > 0)
    sentences.push_back(
        fmt::format("The agents follow the communication-loss rule, and after {} it is too late.",
                    steps_text(count["silent"], spec)));
  sentences.push_back(
      fmt::format("{}, after {} {}.",
                  count["afterwards"] > 0 ? "With the fallback rule" : "Even if all agents then coordinate",
                  steps_text(later, spec), end));
  return sentences;
}

bool is_all_alone(const Json& name, const ProblemSpec& spec) {
  const auto& all = spec.coordination.partitions;
  const auto named =
      std::find_if(all.begin(), all.end(), [&](const auto& partition) { return name == partition.name; });
  const auto& classes = (named == all.end() ? all.front() : *named).classes;
  return std::all_of(classes.begin(), classes.end(), [](const auto& agents) { return agents.size() == 1; });
}

/// The nearest values of one state with which the delay is long enough, in a line.
std::string nearest_text(const Json& entry, const ProblemSpec& spec) {
  if (!entry.contains("nearest") || entry["nearest"].is_null()) return "";
  const Json& nearest = entry["nearest"];
  const auto is_named = [&](const StateSpec& state) { return state.name == nearest["state"]; };
  const auto state = std::find_if(spec.states.begin(), spec.states.end(), is_named);
  const std::string unit = state->unit.empty() ? "" : " " + printable(state->unit);
  const bool is_from = nearest["best"] == "large";
  return fmt::format("  With {} {} {:.6g}{}{} and the other states unchanged, the delay is long enough.\n",
                     state->name, is_from ? "from" : "up to", nearest["value"].get<double>(), unit,
                     is_from ? " on" : "");
}

}  // namespace

std::string steps_text(std::int64_t steps, const ProblemSpec& spec) {
  return duration(steps, nearest_double(spec.dynamics.period), spec.dynamics.unit);
}

std::string worst_key(const Json& entry) {
  const auto& kinds = requirement_kinds();
  return std::find_if(kinds.begin(), kinds.end(),
                      [&entry](const RequirementTraits& kind) { return entry.contains(kind.worst()); })
      ->worst();
}

std::string worst_text(const Json& kind, const Json& value, const Json& status, const ProblemSpec& spec) {
  if (status == "not_safe") return "is not safe";
  if (status == "not_invariant") return "cannot be kept safe, even if all agents coordinate";
  if (status == "not_in_silence_set") return "is not safe with the fallback rule";
  if (status == "goal_cannot_be_forced") return goal_texts(spec.goal_then).cannot;
  const RequirementTraits& traits = requirement_traits(kind.get<std::string>());
  const bool is_risk = traits.is_probability;
  const bool is_arrival = traits.kind == RequirementKind::max_arrival;
  const std::string text = is_arrival ? goal_texts(spec.goal_then).failing : traits.failing;
  return fmt::format(fmt::runtime(text),
                     fmt::arg("steps", is_risk ? "" : steps_text(value.get<std::int64_t>(), spec)),
                     fmt::arg("samples", is_risk ? "" : count_of(value.get<std::int64_t>(), "sample")),
                     fmt::arg("risk", is_risk ? probability_text(value) : ""));
}

std::string outside_text(const Json& entry, const ProblemSpec& spec) {
  REQUIRES(!entry["reaches_outside"].is_null());
  const Json& side = entry["reaches_outside"];
  std::string text = "the region may reach outside the domain, " + side_text(side);
  for (const StateSpec& state : spec.states) {
    if (state.name != text_of(side["state"])) continue;
    const bool is_above = side["side"] == "above";
    text +=
        fmt::format("; add \"and {} {} {:.6g}\" to its \"where\"", state.name,
                    is_above ? "<=" : ">=", nearest_double(is_above ? state.grid.last() : state.grid.first));
  }
  return text;
}

std::string claim_text(const Json& entry, const ProblemSpec& spec) {
  const RequirementTraits& kind = traits_of(entry);
  if (kind.is_probability) {
    const std::string per = entry["per"].is_null() ? "" : " per " + text_of(entry["per"]);
    return fmt::format(fmt::runtime(kind.claim),
                       fmt::arg("risk", fmt::format("{:g}{}", entry[kind.key].get<double>(), per)));
  }
  const bool has_limit = entry.contains(kind.key);
  const std::string steps = has_limit ? steps_text(number_of(entry[kind.key]), spec) : "";
  const std::string samples = has_limit ? count_of(number_of(entry[kind.key]), "sample") : "";
  const bool is_arrival = kind.kind == RequirementKind::max_arrival;
  const std::string text = is_arrival ? goal_texts(spec.goal_then).claim : kind.claim;
  return fmt::format(fmt::runtime(text), fmt::arg("steps", steps), fmt::arg("samples", samples),
                     fmt::arg("partition", entry["partition"].is_null() ? "" : text_of(entry["partition"])));
}

std::string failure_line(const Json& entry, const ProblemSpec& spec) {
  if (entry["holds"]) return {};
  std::string text = entry["counterexample"]["state"].is_null() ? "" : cell_failures(entry, spec);
  if (!entry["reaches_outside"].is_null()) text += (text.empty() ? "" : "; ") + outside_text(entry, spec);
  return text;
}

std::string failure_text(const Json& entry, const ProblemSpec& spec) {
  if (entry["holds"]) return {};
  std::string text;
  if (!entry["reaches_outside"].is_null()) text += fmt::format("  FAILS: {}.\n", outside_text(entry, spec));
  if (entry["counterexample"]["state"].is_null()) return text;
  text += fmt::format("  FAILS: {}.\n", cell_failures(entry, spec)) + nearest_text(entry, spec);
  if (!has_steps(entry)) return text;
  const Counterexample found = counterexample_of(entry);
  text += "\n" + counterexample_text(found, spec, "  ") + "\n";
  for (const std::string& sentence : counterexample_sentences(found, spec)) text += "  " + sentence + "\n";
  return text;
}

bool has_steps(const Json& entry) {
  REQUIRES(entry["holds"] == false);
  return entry["counterexample"]["end"] != "too_risky";
}

Counterexample counterexample_of(const Json& entry) {
  REQUIRES(!entry["counterexample"]["state"].is_null());
  return {.path = entry["counterexample"], .kind = traits_of(entry).kind, .partition = entry["partition"]};
}

CounterexampleTable counterexample_table(const Counterexample& found, const ProblemSpec& spec) {
  const std::string key = found.kind == RequirementKind::invariant ? "" : traits(found.kind).value;
  CounterexampleTable table;
  table.heads = {"step"};
  for (const StateSpec& state : spec.states) table.heads.push_back(column_heading(state.name, state.unit));
  if (!key.empty()) table.heads.push_back(label_of(key));
  table.heads.emplace_back("collision time");
  table.numbers = table.heads.size();
  table.heads.emplace_back("action");
  for (const AgentSpec& agent : spec.agents) table.heads.push_back(agent.name);
  Json samples = found.path["steps"];
  if (!found.path["end_sample"].is_null()) samples.push_back(found.path["end_sample"]);
  for (const Json& sample : samples) {
    std::vector<std::string> row = table_row(sample, key, spec);
    row.insert(row.begin(), grouped(std::uint64_t{table.rows.size()}));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string counterexample_text(const Counterexample& found, const ProblemSpec& spec,
                                const std::string& indent) {
  CounterexampleTable entries = counterexample_table(found, spec);
  std::vector<Table::Align> columns(entries.heads.size(), Table::Align::left);
  std::fill_n(columns.begin(), entries.numbers, Table::Align::right);
  Table table(columns);
  entries.heads.front() = indent + entries.heads.front();
  table.add(entries.heads);
  for (const std::vector<std::string>& row : entries.rows) table.add(row);
  return table.text();
}

namespace {

/// Adds how far the cell of the last state reaches beyond bounds of `safe` that its centre keeps.
void add_reach(const Json& path, const ProblemSpec& spec, std::vector<std::string>& sentences) {
  if (path["end"] != "outside_safe_set" || path["end_sample"].is_null()) return;
  if (spec.abstraction.safe != Membership::inner) return;
  std::vector<std::string> ends;
  for (const StateBound& bound : state_bounds(spec.safe, spec.states.size())) {
    const StateSpec& state = spec.states[bound.state];
    if (state.discrete) continue;
    const auto centre = path["end_sample"]["state"][state.name].get<double>();
    const double half = nearest_double(state.grid.step) / 2, limit = nearest_double(bound.value);
    const double end = bound.is_upper ? centre + half : centre - half;
    const bool is_kept = bound.is_upper ? centre <= limit : centre >= limit;
    const bool is_passed = bound.is_upper ? end > limit : end < limit;
    if (is_kept && is_passed) ends.push_back(fmt::format("{} = {:.6g}", state.name, end));
  }
  if (!ends.empty()) sentences.push_back(fmt::format("The last cell reaches {}.", list_text(ends)));
}

/// Adds the proven number beside the seen one: enclosures are wider than motion.
void add_seen(const Json& path, const ProblemSpec& spec, std::vector<std::string>& sentences) {
  if (path["proven"].is_null()) return;
  const Json& first = path["steps"].front()["action"];
  const bool is_inside = first == "independent" || first == "silent";
  const char* const set = !is_inside                                      ? "the safe set"
                          : first == "silent" && spec.silence->has_then() ? "the silence set"
                                                                          : "the invariance set";
  const std::string seen = path["seen"].is_null() ? fmt::format("stayed in {} for all simulated steps", set)
                                                  : fmt::format("left {} after {}", set,
                                                                steps_text(number_of(path["seen"]), spec));
  const std::string proven = steps_text(number_of(path["proven"]), spec);
  sentences.push_back(fmt::format("{}. A nominal simulation from the first state {}.",
                                  is_inside ? "Proven: " + proven : "On the grid this takes " + proven,
                                  seen));
}

std::vector<std::string> path_sentences(const Counterexample& found, const ProblemSpec& spec) {
  const Json& path = found.path;
  const Json& steps = path["steps"];
  if (steps.empty() && path["end"] == "outside_safe_set") return {"The first state is not safe."};
  const auto count = [&steps](const char* action) {
    return std::count_if(steps.begin(), steps.end(),
                         [action](const Json& step) { return step["action"] == action; });
  };
  if (count("together") > 0)
    return {fmt::format("All agents coordinate on the shortest path, and after {} {}.",
                        steps_text(count("together"), spec), end_text(path, spec))};
  if (found.kind == RequirementKind::min_silence) return silent_sentences(path, spec);
  const std::int64_t alone = count("independent") + count("approaching");
  const std::int64_t evasive = count("evasive");
  std::vector<std::string> sentences;
  if (alone > 0) {
    const std::string text = fmt::format("Each {} independently takes permitted actions, and after {}",
                                         is_all_alone(found.partition, spec) ? "agent" : "class of agents",
                                         steps_text(alone, spec));
    if (evasive == 0 && path["end"] != "no_allowed_action")
      return {fmt::format("{} {}.", text, end_text(path, spec))};
    sentences.push_back(text + " it is too late.");
  }
  if (evasive == 0) {
    sentences.push_back(fmt::format("Then {}.", end_text(path, spec)));
    return sentences;
  }
  const char* const whatever = spec.controller.synthesis == Synthesis::maximal
                                   ? "Even if all agents then coordinate"
                                   : "With inputs that the controller may then choose";
  sentences.push_back(
      fmt::format("{}, after {} {}.", whatever, steps_text(evasive, spec), end_text(path, spec)));
  return sentences;
}

}  // namespace

std::vector<std::string> counterexample_sentences(const Counterexample& found, const ProblemSpec& spec) {
  std::vector<std::string> sentences = path_sentences(found, spec);
  add_reach(found.path, spec, sentences);
  add_seen(found.path, spec, sentences);
  return sentences;
}

std::string requirements_text(const Json& requirements, const ProblemSpec& spec) {
  std::string text;
  for (const Json& entry : requirements) {
    text += fmt::format("\nrequirement {}: {}\n", line_of(entry["name"]), claim_text(entry, spec));
    const std::string region = entry["cells"] == 1 ? "the one cell" : "all " + cells(entry["cells"]);
    text += entry["holds"] ? fmt::format("  holds: for {} that may meet the region\n", region)
                           : failure_text(entry, spec);
  }
  return text;
}

}  // namespace coordreq

#include "app/requirement_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/text.hpp"

namespace coordreq {
namespace {

constexpr std::int32_t kForever = std::numeric_limits<std::int32_t>::max();

std::string steps_text(std::int64_t steps, const ProblemSpec& spec) {
  return duration(steps, nearest_double(spec.dynamics.period), spec.dynamics.unit);
}

std::string number_text(double value) {
  return fmt::format("{:.6g}", value);
}

std::string cells_text(std::uint64_t count) {
  return grouped(count) + (count == 1 ? " cell" : " cells");
}

std::string side_text(const ResultSide& side, const ProblemSpec& spec) {
  return fmt::format("{} {} its grid", spec.states[side.state].name, side.above ? "above" : "below");
}

/// "u1 = 0.5, u2 = 1": what an agent does at a step.
std::string action_text(const AgentSpec& agent, const ResultPath& path, std::size_t step,
                        const ProblemSpec& spec) {
  std::string text;
  for (const std::int32_t i : agent.inputs) {
    const auto input = static_cast<std::size_t>(i);
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", spec.inputs[input].name,
                        number_text(path.input[step * spec.inputs.size() + input]));
  }
  return text;
}

const char* phase_word(EscapePhase phase) {
  return phase == EscapePhase::independent ? "independent" : "evasive";
}

const char* end_word(EscapeEnd end) {
  switch (end) {
    case EscapeEnd::outside_safe_set:
      return "outside_safe_set";
    case EscapeEnd::left_domain:
      return "left_domain";
    case EscapeEnd::unsafe_between_samples:
      return "unsafe_between_samples";
    default:
      return "no_allowed_action";
  }
}

std::string heading(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, printable(unit));
}

std::string delay_cell(std::int32_t delay) {
  return delay == kForever ? "unbounded" : delay < 0 ? "-" : grouped(std::int64_t{delay});
}

std::string time_cell(std::int32_t time) {
  return time == kForever ? "never" : grouped(std::int64_t{time});
}

/// One line a sample: where, what is left, and what each agent does next.
std::string path_table(const ResultPath& path, const ProblemSpec& spec, bool shows_delay) {
  using Align = Table::Align;
  std::vector<Align> columns(2 + spec.states.size() + (shows_delay ? 1 : 0), Align::right);
  columns.insert(columns.end(), 1 + spec.agents.size(), Align::left);
  Table table(columns);
  std::vector<std::string> head = {"  step"};
  for (const StateSpec& state : spec.states) head.push_back(heading(state.name, state.unit));
  if (shows_delay) head.emplace_back("delay");
  head.emplace_back("collision time");
  head.emplace_back("action");
  for (const AgentSpec& agent : spec.agents) head.push_back(agent.name);
  table.add(head);
  for (std::size_t s = 0; s < path.samples(); ++s) {
    std::vector<std::string> row = {grouped(static_cast<std::uint64_t>(s))};
    for (std::size_t i = 0; i < spec.states.size(); ++i)
      row.push_back(number_text(path.state[s * spec.states.size() + i]));
    if (shows_delay) row.push_back(delay_cell(path.delay[s]));
    row.push_back(time_cell(path.collision_time[s]));
    row.emplace_back(s < path.steps() ? phase_word(path.phase[s]) : "");
    for (const AgentSpec& agent : spec.agents)
      row.push_back(s < path.steps() ? action_text(agent, path, s, spec) : "");
    table.add(row);
  }
  return table.text();
}

std::int64_t independent_steps(const ResultPath& path) {
  return std::count(path.phase.begin(), path.phase.end(), EscapePhase::independent);
}

std::string end_text(const ResultPath& path, const ProblemSpec& spec) {
  switch (path.end) {
    case EscapeEnd::outside_safe_set:
      return "the state is no longer safe";
    case EscapeEnd::left_domain:
      return "the state leaves the domain, " + side_text(*path.left_side, spec);
    case EscapeEnd::unsafe_between_samples:
      return "the way to the next sample is not safe";
    default:
      return "no action is allowed any more";
  }
}

bool is_all_alone(const RequirementSpec& requirement, const ProblemSpec& spec) {
  const auto partition = static_cast<std::size_t>(requirement.partition.value_or(0));
  const auto& classes = spec.coordination.partitions[partition].classes;
  return std::all_of(classes.begin(), classes.end(), [](const auto& agents) { return agents.size() == 1; });
}

/// The path in words.
std::string path_words(const ResultPath& path, const RequirementSpec& requirement, const ProblemSpec& spec) {
  if (path.steps() == 0 && path.end == EscapeEnd::outside_safe_set)
    return "  It is not safe to begin with.\n";
  const std::int64_t alone = independent_steps(path);
  const auto evasive = static_cast<std::int64_t>(path.steps()) - alone;
  std::string text;
  if (alone > 0) {
    text =
        fmt::format("  Each {} does what is reasonable to it alone, and after {}",
                    is_all_alone(requirement, spec) ? "agent" : "class of agents", steps_text(alone, spec));
    if (evasive == 0 && path.end != EscapeEnd::no_allowed_action)
      return text + fmt::format(" {}.\n", end_text(path, spec));
    text += " it is too late.\n";
  }
  if (evasive == 0) return text + fmt::format("  Then {}.\n", end_text(path, spec));
  const char* const whatever = spec.controller.synthesis == Synthesis::maximal
                                   ? "Whatever all agents then do together"
                                   : "With what the controller then may choose";
  return text +
         fmt::format("  {}, after {} {}.\n", whatever, steps_text(evasive, spec), end_text(path, spec));
}

std::string where_text(const ResultPath& path, const ProblemSpec& spec) {
  std::string text;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", spec.states[i].name, number_text(path.state[i]));
  }
  return text;
}

/// What is the matter with the worst cell.
std::string worst_text(std::int32_t delay, const ProblemSpec& spec) {
  if (delay == -2) return "is not safe";
  if (delay == -1) return "cannot be kept safe, even if all agents coordinate";
  return "has a delay of " + steps_text(delay, spec);
}

Json side_json(const std::optional<ResultSide>& side, const ProblemSpec& spec) {
  if (!side) return {};
  return {{"state", spec.states[side->state].name}, {"side", side->above ? "above" : "below"}};
}

Json state_json(const ResultPath& path, std::size_t sample, const ProblemSpec& spec) {
  Json json = Json::object();
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    json[spec.states[i].name] = path.state[sample * spec.states.size() + i];
  return json;
}

Json sample_json(const ResultPath& path, std::size_t sample, const ProblemSpec& spec) {
  const std::int32_t time = path.collision_time[sample];
  Json json;
  json["state"] = state_json(path, sample, spec);
  json["cell"] = path.cell[sample];
  json["delay"] = delay_json(path.delay[sample]);
  json["delay_status"] = delay_word(path.delay[sample]);
  json["collision_time"] = time == kForever ? Json() : Json(time);
  return json;
}

Json step_json(const ResultPath& path, std::size_t step, const ProblemSpec& spec) {
  Json json = sample_json(path, step, spec);
  json["action"] = phase_word(path.phase[step]);
  json["inputs"] = Json::object();
  for (const AgentSpec& agent : spec.agents) {
    Json& own = json["inputs"][agent.name] = Json::object();
    for (const std::int32_t i : agent.inputs) {
      const auto input = static_cast<std::size_t>(i);
      own[spec.inputs[input].name] = path.input[step * spec.inputs.size() + input];
    }
  }
  return json;
}

Json counterexample_json(const ResultRequirement& result, const ProblemSpec& spec) {
  Json json;
  if (!result.path) {
    json["state"] = Json();
    json["steps"] = Json::array();
    json["end"] = "outside_domain";
    json["end_sample"] = Json();
    json["left_side"] = side_json(result.reached_side, spec);
    return json;
  }
  const ResultPath& path = *result.path;
  json["state"] = state_json(path, 0, spec);
  json["steps"] = Json::array();
  for (std::size_t s = 0; s < path.steps(); ++s) json["steps"].push_back(step_json(path, s, spec));
  json["end"] = end_word(path.end);
  const bool stays = path.samples() > path.steps();
  json["end_sample"] = stays ? sample_json(path, path.steps(), spec) : Json();
  json["left_side"] = side_json(path.left_side, spec);
  return json;
}

std::string cell_failures(const ResultRequirement& result, const ProblemSpec& spec) {
  return fmt::format("{} of {} {}, the worst at {}: it {}", grouped(result.failing), cells_text(result.cells),
                     result.failing == 1 ? "fails" : "fail", where_text(*result.path, spec),
                     worst_text(result.path->delay.front(), spec));
}

std::string outside_failure(const ResultRequirement& result, const ProblemSpec& spec) {
  return fmt::format("the region may reach outside the domain, {}", side_text(*result.reached_side, spec));
}

}  // namespace

Json delay_json(std::int32_t delay) {
  return delay < 0 || delay == kForever ? Json() : Json(delay);
}

std::string delay_word(std::int32_t delay) {
  if (delay == kForever) return "unbounded";
  return delay == -2 ? "not_safe" : delay == -1 ? "not_invariant" : "steps";
}

std::string requirement_claim(const RequirementSpec& requirement, const ProblemSpec& spec) {
  if (requirement.invariant) return "in the invariance set";
  return fmt::format("delay of {} at least {}",
                     spec.coordination.partitions[static_cast<std::size_t>(*requirement.partition)].name,
                     steps_text(*requirement.min_delay, spec));
}

std::string failure_line(const ResultRequirement& result, const ProblemSpec& spec) {
  if (result.holds) return {};
  std::string text = result.path ? cell_failures(result, spec) : "";
  if (result.reached_side) text += (text.empty() ? "" : "; ") + outside_failure(result, spec);
  return text;
}

std::string failure_text(const ResultRequirement& result, const RequirementSpec& requirement,
                         const ProblemSpec& spec) {
  std::string text;
  if (result.reached_side) text += fmt::format("  FAILS: {}.\n", outside_failure(result, spec));
  if (!result.path) return text;
  text += fmt::format("  FAILS: {}.\n\n", cell_failures(result, spec));
  text += path_table(*result.path, spec, !requirement.invariant) + "\n" +
          path_words(*result.path, requirement, spec);
  return text;
}

std::string requirements_text(const AnalysisSummary& summary, const ProblemSpec& spec) {
  std::string text;
  for (std::size_t r = 0; r < summary.requirements.size(); ++r) {
    const ResultRequirement& result = summary.requirements[r];
    text += fmt::format("\nrequirement {}: {}\n", printable(result.name),
                        requirement_claim(spec.requirements[r], spec));
    text += result.holds
                ? fmt::format("  holds: for all {} that may meet the region\n", cells_text(result.cells))
                : failure_text(result, spec.requirements[r], spec);
  }
  return text;
}

Json requirements_json(const AnalysisSummary& summary, const ProblemSpec& spec) {
  Json all = Json::array();
  for (std::size_t r = 0; r < summary.requirements.size(); ++r) {
    const ResultRequirement& result = summary.requirements[r];
    const RequirementSpec& asked = spec.requirements[r];
    Json& json = all.emplace_back();
    json["name"] = result.name;
    json["holds"] = result.holds;
    json["kind"] = asked.invariant ? "invariant" : "min_delay";
    json["partition"] =
        asked.partition ? Json(spec.coordination.partitions[static_cast<std::size_t>(*asked.partition)].name)
                        : Json();
    json["min_delay"] = asked.min_delay ? Json(*asked.min_delay) : Json();
    json["cells"] = result.cells;
    json["failing"] = result.failing;
    json["least_delay"] = delay_json(result.least_delay);
    json["least_delay_status"] = delay_word(result.least_delay);
    json["reaches_outside"] = side_json(result.reached_side, spec);
    json["counterexample"] = result.holds ? Json() : counterexample_json(result, spec);
  }
  return all;
}

}  // namespace coordreq

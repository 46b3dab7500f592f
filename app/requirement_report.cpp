#include "app/requirement_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/requirement_story.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

constexpr std::int32_t kForever = std::numeric_limits<std::int32_t>::max();

std::string cells_text(std::uint64_t count) {
  return grouped(count) + (count == 1 ? " cell" : " cells");
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

/// The story as a table and in sentences.
std::string story_text(const ResultPath& path, const RequirementSpec& requirement, const ProblemSpec& spec) {
  const StoryTable story = story_table(path, requirement, spec);
  std::vector<Table::Align> columns(story.heads.size(), Table::Align::left);
  std::fill_n(columns.begin(), story.numbers, Table::Align::right);
  Table table(columns);
  std::vector<std::string> heads = story.heads;
  heads.front() = "  " + heads.front();
  table.add(heads);
  for (const std::vector<std::string>& row : story.rows) table.add(row);
  std::string text = table.text() + "\n";
  for (const std::string& sentence : story_sentences(path, requirement, spec)) text += "  " + sentence + "\n";
  return text;
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
                     result.failing == 1 ? "fails" : "fail", start_text(*result.path, spec),
                     worst_text(result.path->delay.front(), spec));
}

}  // namespace

std::string worst_text(std::int32_t delay, const ProblemSpec& spec) {
  if (delay == -2) return "is not safe";
  if (delay == -1) return "cannot be kept safe, even if all agents coordinate";
  return "has a delay of " + steps_text(delay, spec);
}

std::string outside_text(const ResultRequirement& result, const ProblemSpec& spec) {
  return fmt::format("the region may reach outside the domain, {}", side_text(*result.reached_side, spec));
}

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
  if (result.reached_side) text += (text.empty() ? "" : "; ") + outside_text(result, spec);
  return text;
}

std::string failure_text(const ResultRequirement& result, const RequirementSpec& requirement,
                         const ProblemSpec& spec) {
  std::string text;
  if (result.reached_side) text += fmt::format("  FAILS: {}.\n", outside_text(result, spec));
  if (!result.path) return text;
  text += fmt::format("  FAILS: {}.\n\n", cell_failures(result, spec));
  return text + story_text(*result.path, requirement, spec);
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

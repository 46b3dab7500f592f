#include "app/requirement_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/text.hpp"

namespace coordreq {
namespace {

constexpr std::int32_t kForever = std::numeric_limits<std::int32_t>::max();

std::string number_text(double value) {
  return fmt::format("{:.6g}", value);
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

std::string delay_cell(std::int32_t delay) {
  return delay == kForever ? "unbounded" : delay < 0 ? "-" : grouped(std::int64_t{delay});
}

std::string time_cell(std::int32_t time) {
  return time == kForever ? "never" : grouped(std::int64_t{time});
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

}  // namespace

std::string steps_text(std::int64_t steps, const ProblemSpec& spec) {
  return duration(steps, nearest_double(spec.dynamics.period), spec.dynamics.unit);
}

std::string start_text(const ResultPath& path, const ProblemSpec& spec) {
  std::string text;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", spec.states[i].name, number_text(path.state[i]));
  }
  return text;
}

std::string side_text(const ResultSide& side, const ProblemSpec& spec) {
  return fmt::format("{} {} its grid", spec.states[side.state].name, side.above ? "above" : "below");
}

const char* phase_word(EscapePhase phase) {
  return phase == EscapePhase::independent ? "independent" : "evasive";
}

StoryTable story_table(const ResultPath& path, const RequirementSpec& requirement, const ProblemSpec& spec) {
  const bool shows_delay = !requirement.invariant;
  StoryTable table;
  table.heads = {"step"};
  for (const StateSpec& state : spec.states) table.heads.push_back(column_heading(state.name, state.unit));
  if (shows_delay) table.heads.emplace_back("delay");
  table.heads.emplace_back("collision time");
  table.numbers = table.heads.size();
  table.heads.emplace_back("action");
  for (const AgentSpec& agent : spec.agents) table.heads.push_back(agent.name);
  for (std::size_t s = 0; s < path.samples(); ++s) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(grouped(static_cast<std::uint64_t>(s)));
    for (std::size_t i = 0; i < spec.states.size(); ++i)
      row.push_back(number_text(path.state[s * spec.states.size() + i]));
    if (shows_delay) row.push_back(delay_cell(path.delay[s]));
    row.push_back(time_cell(path.collision_time[s]));
    row.emplace_back(s < path.steps() ? phase_word(path.phase[s]) : "");
    for (const AgentSpec& agent : spec.agents)
      row.push_back(s < path.steps() ? action_text(agent, path, s, spec) : "");
  }
  return table;
}

std::vector<std::string> story_sentences(const ResultPath& path, const RequirementSpec& requirement,
                                         const ProblemSpec& spec) {
  if (path.steps() == 0 && path.end == EscapeEnd::outside_safe_set) return {"It is not safe to begin with."};
  const std::int64_t alone = std::count(path.phase.begin(), path.phase.end(), EscapePhase::independent);
  const auto evasive = static_cast<std::int64_t>(path.steps()) - alone;
  std::vector<std::string> sentences;
  if (alone > 0) {
    const std::string text =
        fmt::format("Each {} does what is reasonable to it alone, and after {}",
                    is_all_alone(requirement, spec) ? "agent" : "class of agents", steps_text(alone, spec));
    if (evasive == 0 && path.end != EscapeEnd::no_allowed_action)
      return {fmt::format("{} {}.", text, end_text(path, spec))};
    sentences.push_back(text + " it is too late.");
  }
  if (evasive == 0) {
    sentences.push_back(fmt::format("Then {}.", end_text(path, spec)));
    return sentences;
  }
  const char* const whatever = spec.controller.synthesis == Synthesis::maximal
                                   ? "Whatever all agents then do together"
                                   : "With what the controller then may choose";
  sentences.push_back(
      fmt::format("{}, after {} {}.", whatever, steps_text(evasive, spec), end_text(path, spec)));
  return sentences;
}

}  // namespace coordreq

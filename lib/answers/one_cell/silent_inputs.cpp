#include "answers/one_cell/silent_inputs.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {

SilentInputs::SilentInputs(const ProblemSpec& spec, Part part,
                           const std::vector<std::vector<std::int32_t>>& classes, const CellPosts& posts)
    : members_(classes) {
  const bool is_then = part == Part::then;
  const auto& rules = is_then ? spec.silence->then : spec.silence->actions;
  const std::string pointer = is_then ? "/silence/then" : "/silence/actions";
  for (std::size_t i = 0; i < rules.size(); ++i) {
    Agent& agent =
        agents_.emplace_back(Agent{.inputs = class_of(spec, posts.inputs(), {static_cast<std::int32_t>(i)}),
                                   .parts = {},
                                   .rule = {},
                                   .permitted = {}});
    agent.parts = agent.inputs.parts();
    if (rules[i])
      agent.rule.emplace(spec, *rules[i], posts, "the condition",
                         member_pointer(pointer, spec.agents[i].name));
  }
  for (const std::vector<std::int32_t>& own : classes) {
    classes_.push_back(class_of(spec, posts.inputs(), own));
    classes_.back().tabulate();
    parts_.push_back(classes_.back().parts());
  }
}

bool SilentInputs::asks_controller() const {
  return std::ranges::any_of(agents_, [](const Agent& agent) { return !agent.rule; });
}

std::vector<SilentInputs::Numbers> SilentInputs::of(std::int64_t x, const Numbers& admissible) {
  for (Agent& agent : agents_) {
    agent.permitted.assign(agent.parts.size(), true);
    for (std::size_t a = 0; agent.rule && a < agent.parts.size(); ++a)
      agent.permitted[a] = agent.rule->holds(x, agent.parts[a]);
  }
  std::vector<Numbers> result(classes_.size());
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    std::vector<bool> is_open(parts_[c].size(), true);
    const bool has_rules =
        std::ranges::all_of(members_[c], [&](std::int32_t i) { return agents_[at(i)].rule.has_value(); });
    if (!has_rules) {
      is_open.assign(is_open.size(), false);
      for (const std::int64_t a : classes_[c].project(admissible)) is_open[at(a)] = true;
    }
    for (std::size_t a = 0; a < is_open.size(); ++a) {
      const bool is_permitted = std::ranges::all_of(members_[c], [&](std::int32_t i) {
        const Agent& agent = agents_[at(i)];
        return agent.permitted[at(agent.inputs.action(parts_[c][a]))];
      });
      if (is_open[a] && is_permitted) result[c].push_back(static_cast<std::int64_t>(a));
    }
  }
  return result;
}

SilentInputs::Numbers SilentInputs::joint(std::int64_t x, const Numbers& admissible) {
  Numbers result = {0};
  const std::vector<Numbers> actions = of(x, admissible);
  for (std::size_t c = 0; c < actions.size(); ++c) {
    Numbers longer;
    for (const std::int64_t before : result) {
      for (const std::int64_t a : actions[c]) longer.push_back(before + parts_[c][at(a)]);
    }
    result = std::move(longer);
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace coordreq

#include "answers/convention/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/convention/convention.hpp"
#include "answers/goal/answer.hpp"
#include "answers/paths.hpp"
#include "base/grouped.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

class ConventionPolicy : public CellPolicy {
 public:
  explicit ConventionPolicy(const PolicyContext& context)
      : joint_inputs_(context.posts->inputs().count()),
        goal_policy_(context.spec->goal ? make_goal_policy(context) : nullptr) {}

  bool holds(std::int64_t /*cell*/) override { return true; }

  const Numbers& together(std::int64_t cell, const Numbers& admissible) override {
    return goal_policy_ && goal_policy_->holds(cell) ? goal_policy_->together(cell, admissible) : admissible;
  }

  std::vector<Numbers> alone(std::int64_t /*cell*/, std::int32_t /*countdown*/, const Numbers& together,
                             const std::vector<InputClass>& classes) override {
    std::vector<bool> inputs(at(joint_inputs_), false);
    for (const std::int64_t u : together) inputs[at(u)] = true;
    std::vector<Numbers> actions;
    for (const std::vector<bool>& kept_actions : convention_at(inputs, classes)) {
      Numbers& numbers = actions.emplace_back();
      for (std::size_t a = 0; a < kept_actions.size(); ++a) {
        if (kept_actions[a]) numbers.push_back(static_cast<std::int64_t>(a));
      }
    }
    return actions;
  }

 private:
  std::int64_t joint_inputs_;
  std::unique_ptr<CellPolicy> goal_policy_;
};

/// The actions that the convention leaves to each agent, which needs no coordination at all: on the way to a
/// goal in P(x), else in C(x).
AnswerPolicy convention_policy() {
  return {.name = "convention",
          .label = "actions",
          .is_by_agent = true,
          .make = [](const PolicyContext& context) -> std::unique_ptr<CellPolicy> {
            return std::make_unique<ConventionPolicy>(context);
          },
          .stored = [](const ProblemSpec& spec, const PartitionSpec& /*partition*/,
                       std::size_t agent) { return paths::convention(spec.agents[agent]); }};
}

}  // namespace

/// Explains how many of its actions each agent would keep, and that it could be silent indefinitely.
Explained explain_convention(const ExplainContext& context) {
  Explained result{.key = "convention", .json = std::make_shared<Json>(Json::array())};
  if (context.delay < 0) return result;
  const std::vector<std::vector<bool>> actions = context.actions(convention_policy());
  std::vector<std::string> items;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const std::string& agent = context.spec->agents[i].name;
    const auto kept = std::count(actions[i].begin(), actions[i].end(), true);
    result.json->push_back({{"agent", agent}, {"kept", kept}, {"total", actions[i].size()}});
    items.push_back(fmt::format("{} {} of {}", agent, grouped(std::int64_t{kept}),
                                grouped(std::uint64_t{actions[i].size()})));
  }
  if (!context.is_bounded) return result;
  result.sentences = {
      fmt::format("With a convention (\"convention\": true) the agents would keep these actions here: {}; "
                  "agents that keep to it never need to coordinate.",
                  list_text(items))};
  return result;
}

/// None unless the spec asks for a convention.
std::vector<AnswerPolicy> convention_policies(const ProblemSpec& spec) {
  if (!spec.coordination.convention) return {};
  return {convention_policy()};
}

}  // namespace coordreq

#include "answers/plan.hpp"

#include <algorithm>
#include <utility>

#include "answers/blind/answer.hpp"
#include "answers/blind/check.hpp"
#include "answers/blind/explain.hpp"
#include "answers/blind/fields.hpp"
#include "answers/blind/policy.hpp"
#include "answers/coalition/answer.hpp"
#include "answers/coalition/check.hpp"
#include "answers/coalition/fields.hpp"
#include "answers/context/answer.hpp"
#include "answers/context/fields.hpp"
#include "answers/convention/answer.hpp"
#include "answers/convention/check.hpp"
#include "answers/convention/fields.hpp"
#include "answers/convention/policy.hpp"
#include "answers/goal/answer.hpp"
#include "answers/goal/check.hpp"
#include "answers/goal/fields.hpp"
#include "answers/goal/policy.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/check.hpp"
#include "answers/invariance/fields.hpp"
#include "answers/layers/answer.hpp"
#include "answers/layers/check.hpp"
#include "answers/layers/fields.hpp"
#include "answers/layers/policy.hpp"
#include "answers/network/answer.hpp"
#include "answers/network/check.hpp"
#include "answers/network/fields.hpp"
#include "answers/requirements/answer.hpp"
#include "answers/requirements/check.hpp"
#include "answers/requirements/fields.hpp"
#include "answers/risk/answer.hpp"
#include "answers/risk/check.hpp"
#include "answers/risk/fields.hpp"
#include "answers/silence/answer.hpp"
#include "answers/silence/check.hpp"
#include "answers/silence/fields.hpp"
#include "answers/silence/policy.hpp"

namespace coordreq {

const std::vector<Answer>& all_answers() {
  static const std::vector<Answer> plan = {
      {.stages = context_stages,
       .memory = context_memory,
       .fields = context_fields,
       .fill = fill_context_fields,
       .summarise = summarise_context},
      {.stages = invariance_stages,
       .memory = invariance_memory,
       .fields = invariance_fields,
       .fill = fill_invariance_fields,
       .summarise = summarise_invariance,
       .tell = tell_invariance,
       .check = check_invariance},
      {.stages = layers_stages,
       .memory = layers_memory,
       .fields = layer_fields,
       .fill = fill_layer_fields,
       .summarise = summarise_layers,
       .examine = examine_layers,
       .tell = tell_layers,
       .policies = layer_policies,
       .check = check_layers},
      {.stages = goal_stages,
       .memory = goal_memory,
       .fields = goal_fields,
       .fill = fill_goal_fields,
       .summarise = summarise_goal,
       .tell = tell_goal,
       .advise = advise_on_goal,
       .policies = goal_policies,
       .check = check_goal},
      {.stages = coalition_stages,
       .memory = coalition_memory,
       .fields = coalition_fields,
       .fill = fill_coalition_fields,
       .summarise = summarise_coalition,
       .tell = tell_coalition,
       .check = check_coalition},
      {.stages = network_stages,
       .memory = network_memory,
       .fields = network_fields,
       .fill = fill_network_fields,
       .summarise = summarise_network,
       .examine = examine_network,
       .tell = tell_network,
       .advise = advise_on_network,
       .check = check_network,
       .check_memory = network_check_memory},
      {.stages = risk_stages,
       .memory = risk_memory,
       .fields = risk_fields,
       .fill = fill_risk_fields,
       .summarise = summarise_risk,
       .examine = examine_risk,
       .tell = tell_risk,
       .check = check_risk,
       .check_memory = risk_check_memory},
      {.stages = convention_stages,
       .memory = convention_memory,
       .fields = convention_fields,
       .fill = fill_convention_fields,
       .summarise = summarise_convention,
       .policies = convention_policies,
       .explain = explain_convention,
       .check = check_convention},
      {.stages = blind_stages,
       .memory = blind_memory,
       .fields = blind_fields,
       .fill = fill_blind_fields,
       .summarise = summarise_blind,
       .tell = tell_blind,
       .advise = advise_on_blind,
       .policies = blind_policies,
       .explain = explain_blind,
       .check = check_blind,
       .check_memory = blind_check_memory},
      {.stages = silence_stages,
       .memory = silence_memory,
       .fields = silence_fields,
       .fill = fill_silence_fields,
       .summarise = summarise_silence,
       .tell = tell_silence,
       .advise = advise_on_silence,
       .policies = silence_policies,
       .check = check_silence,
       .check_memory = silence_check_memory},
      {.checks = requirements_checks,
       .stages = requirements_stages,
       .memory = requirements_memory,
       .fields = requirement_fields,
       .fill = fill_requirement_fields,
       .summarise = summarise_requirements,
       .examine = examine_requirements,
       .tell = tell_requirements,
       .check = check_requirements,
       .check_memory = requirements_check_memory},
  };
  return plan;
}

std::vector<Stage> answer_stages(const ProblemSpec& spec) {
  std::vector<Stage> stages;
  for (const Answer& answer : all_answers()) {
    for (Stage& stage : answer.stages(spec)) stages.push_back(std::move(stage));
  }
  return stages;
}

std::vector<AnswerPolicy> answer_policies(const ProblemSpec& spec) {
  std::vector<AnswerPolicy> policies;
  for (const Answer& answer : all_answers()) {
    if (answer.policies == nullptr) continue;
    for (AnswerPolicy& policy : answer.policies(spec)) policies.push_back(std::move(policy));
  }
  return policies;
}

std::vector<AnswerPolicy> headline_policies(const ProblemSpec& spec) {
  std::vector<AnswerPolicy> policies = answer_policies(spec);
  std::erase_if(policies,
                [](const AnswerPolicy& policy) { return !policy.name.empty() && policy.headline.empty(); });
  std::reverse(policies.begin(), policies.end());
  return policies;
}

void run_stages(const std::vector<Stage>& stages, Answers& answers, const StageWork& work,
                const PlanWatch& watch) {
  for (const Stage& stage : stages) {
    if (watch.enter) watch.enter(stage.name);
    StageWork inner_work = work;
    inner_work.store = watch.store ? watch.store(stage.name) : nullptr;
    stage.run(answers, inner_work);
  }
}

}  // namespace coordreq

#include "answers/plan.hpp"

#include <algorithm>
#include <utility>

#include "answers/blind/answer.hpp"
#include "answers/coalition/answer.hpp"
#include "answers/context/answer.hpp"
#include "answers/convention/answer.hpp"
#include "answers/goal/answer.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/network/answer.hpp"
#include "answers/requirements/answer.hpp"
#include "answers/risk/answer.hpp"
#include "answers/silence/answer.hpp"
#include "base/process_memory.hpp"

namespace coordreq {

const std::vector<Answer>& all_answers() {
  static const std::vector<Answer> plan = {
      context_answer, invariance_answer, layers_answer, goal_answer,    coalition_answer,   network_answer,
      risk_answer,    convention_answer, blind_answer,  silence_answer, requirements_answer};
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
    // What it has freed would count for the next stage too: with sixteen threads three vehicles took 106 MiB
    // instead of 97.
    give_back_memory();
  }
}

}  // namespace coordreq

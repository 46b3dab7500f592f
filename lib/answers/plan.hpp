#pragma once

#include <functional>
#include <string>
#include <vector>

#include "answers/answer.hpp"

namespace coordreq {

/// All answers, in the order of need; the first is the context, which all others need.
[[nodiscard]] const std::vector<Answer>& all_answers();

/// The stages of all answers that the spec asks for, in order.
[[nodiscard]] std::vector<Stage> answer_stages(const ProblemSpec& spec);

/// The policies of all answers that the spec asks for, in order; the first is the policy of the delays.
[[nodiscard]] std::vector<AnswerPolicy> answer_policies(const ProblemSpec& spec);

/// Those that answer how long silence is safe: first what the spec asks for (a rule, agents that see only
/// themselves), last independent choice.
[[nodiscard]] std::vector<AnswerPolicy> headline_policies(const ProblemSpec& spec);

/// Observers of stages, and stores for them.
struct PlanWatch {
  /// Called when a stage begins; may be empty.
  std::function<void(const std::string& stage)> enter = {};
  /// Gives the store of a stage, or null; may be empty.
  std::function<StageStore*(const std::string& stage)> store = {};
};

/// Works out one stage after the other. @param work its store is not looked at
void run_stages(const std::vector<Stage>& stages, Answers& answers, const StageWork& work,
                const PlanWatch& watch = {});

}  // namespace coordreq

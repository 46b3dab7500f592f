#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "answers/answer.hpp"
#include "answers/convention/convention_freedom.hpp"
#include "answers/goal/answer.hpp"
#include "engine/action_groups.hpp"

namespace coordreq {

/// A convention and its cost. With a goal it lies in P on the way to the goal, so that agents arrive in time.
struct ConventionAnswer {
  std::unique_ptr<const PiecewiseController> controller;
  std::deque<ActionGrouping> agents;  ///< [part] with the actions of each agent as a class of their own
  ConventionFreedom freedom;
};

extern const Answer convention_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields convention_fields(const ProblemSpec& spec);
void fill_convention_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);
[[nodiscard]] std::vector<AnswerPolicy> convention_policies(const ProblemSpec& spec);
[[nodiscard]] Explained explain_convention(const ExplainContext& context);

}  // namespace coordreq

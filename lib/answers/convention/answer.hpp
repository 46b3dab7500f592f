#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "answers/answers.hpp"
#include "answers/convention/convention_freedom.hpp"
#include "answers/goal/answer.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"
#include "engine/action_groups.hpp"

namespace coordreq {

/// A convention and its cost. With a goal it lies in P on the way to the goal, so that agents arrive in time.
struct ConventionAnswer {
  std::unique_ptr<const ControllerParts> controller;
  std::deque<ActionGrouping> agents;  ///< [part] with the actions of each agent as a class of their own
  ConventionFreedom freedom;
};

/// Adds ConventionAnswer, if the spec asks for one: "convention".
[[nodiscard]] std::vector<Stage> convention_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed convention_memory(const EngineSizes& sizes, int threads);
void summarise_convention(const Answers& answers, Json& summary, Json& work);

}  // namespace coordreq

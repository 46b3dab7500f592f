#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/convention/convention_freedom.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"
namespace coordreq {

/// A convention and what it costs; the actions of each agent are a class of their own.
struct ConventionAnswer {
  ActionGrouping agents;
  ConventionFreedom freedom;
};

/// Adds ConventionAnswer, if the spec asks for one: "convention".
[[nodiscard]] std::vector<Stage> convention_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed convention_memory(const EngineSizes& sizes, int threads);
void summarise_convention(const Answers& answers, Json& summary, Json& work);

}  // namespace coordreq

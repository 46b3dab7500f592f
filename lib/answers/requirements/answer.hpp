#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/memory_need.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"
namespace coordreq {

/// The verdicts.
struct RequirementVerdicts {
  std::vector<ResultRequirement> requirements;  ///< in the order of the spec
};

/// "regions", if there are requirements: refuses a region that meets no cell.
[[nodiscard]] std::vector<Stage> requirements_checks(const ProblemSpec& spec);
/// Adds RequirementVerdicts, if there are any: "requirements".
[[nodiscard]] std::vector<Stage> requirements_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed requirements_memory(const EngineSizes& sizes, int threads);
void summarise_requirements(const Answers& answers, Json& summary, Json& work);

}  // namespace coordreq

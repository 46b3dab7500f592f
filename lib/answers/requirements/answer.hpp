#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
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
/// Adds RequirementVerdicts, if there are requirements: "requirements".
[[nodiscard]] std::vector<Stage> requirements_stages(const ProblemSpec& spec);
/// One requirement for the summary, with the story of its counterexample.
[[nodiscard]] Json requirement_json(const ResultRequirement& result, const RequirementSpec& asked,
                                    const ProblemSpec& spec);
/// The counterexample of a requirement of this kind, step by step.
[[nodiscard]] Json story_json(const ResultPath& path, RequirementKind kind, const ProblemSpec& spec);
/// A delay as in `/delay`: the number of steps, else null.
[[nodiscard]] Json delay_json(std::int32_t delay);
/// "steps", "unbounded", "not_invariant", "not_safe" or "goal_cannot_be_forced".
[[nodiscard]] const char* delay_word(std::int32_t delay);
[[nodiscard]] MemoryNeed requirements_memory(const EngineSizes& sizes, int threads);
void summarise_requirements(const Answers& answers, Json& summary, Json& work);
/// Fails if verdicts and counterexamples do not fit together.
void examine_requirements(const ProblemSpec& spec, const FieldSource& source);
void tell_requirements(const ProblemSpec& spec, const FieldSource& source, Json& info);

}  // namespace coordreq

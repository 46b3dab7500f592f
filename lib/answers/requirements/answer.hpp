#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/answer.hpp"
#include "answers/requirements/result_requirement.hpp"

namespace coordreq {

/// The verdicts.
struct RequirementVerdicts {
  std::vector<ResultRequirement> requirements;  ///< in the order of the spec
};

/// One requirement for the summary, with its counterexample.
[[nodiscard]] Json requirement_json(const ResultRequirement& result, const RequirementSpec& requirement,
                                    const ProblemSpec& spec);
/// The counterexample of a requirement of this kind, step by step.
[[nodiscard]] Json path_json(const ResultPath& path, RequirementKind kind, const ProblemSpec& spec);
/// A delay as in `/delay`: the number of steps, else null.
[[nodiscard]] Json delay_json(std::int32_t delay);
/// "steps", "unbounded", "not_invariant", "not_safe" or "goal_cannot_be_forced".
[[nodiscard]] const char* delay_label(std::int32_t delay);

extern const Answer requirements_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields requirement_fields(const ProblemSpec& spec);
void fill_requirement_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

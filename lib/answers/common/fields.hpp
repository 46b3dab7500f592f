#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

[[nodiscard]] Fields common_fields(const ProblemSpec& spec);

/// What was found for them. The arrays refer to the answers, which must outlive the writing.
void fill_common_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

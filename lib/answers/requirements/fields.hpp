#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Verdicts, and the counterexamples of those that fail: each in a group of its own, by its position among
/// the requirements.
[[nodiscard]] Fields requirement_fields(const ProblemSpec& spec);

/// Fills in the values of these fields.
void fill_requirement_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The axes of states, inputs and partitions; on request the finite abstraction.
[[nodiscard]] Fields context_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_context_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

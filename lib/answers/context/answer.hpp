#pragma once

#include <vector>

#include "answers/answer.hpp"

namespace coordreq {

extern const Answer context_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields context_fields(const ProblemSpec& spec);
void fill_context_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

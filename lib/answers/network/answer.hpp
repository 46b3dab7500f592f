#pragma once

#include <vector>

#include "answers/answer.hpp"
#include "answers/network/network_safety.hpp"

namespace coordreq {

extern const Answer network_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields network_fields(const ProblemSpec& spec);
void fill_network_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

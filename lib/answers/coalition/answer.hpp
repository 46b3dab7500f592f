#pragma once

#include <string>
#include <vector>

#include "answers/answer.hpp"
#include "answers/coalition/coalition_map.hpp"

namespace coordreq {

/// "first+second".
[[nodiscard]] std::string pair_name(const ProblemSpec& spec, const AgentPair& pair);

/// The names of the pairs of agents in the file, in their order: "a+b".
[[nodiscard]] std::vector<std::string> pair_names(const ProblemSpec& spec);

extern const Answer coalition_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields coalition_fields(const ProblemSpec& spec);
void fill_coalition_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

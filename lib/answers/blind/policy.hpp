#pragma once

#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// Agents who see only themselves (contract, section 8): those who coordinate choose from C(x), and count
/// down from the least blind countdown of all cells that may be next, for nobody will know which of these it
/// is. Each class then chooses from the row of its silent table, by what it sees. None if all agents see
/// everything.
[[nodiscard]] std::vector<AnswerPolicy> blind_policies(const ProblemSpec& spec);

}  // namespace coordreq

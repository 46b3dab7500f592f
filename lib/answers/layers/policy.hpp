#pragma once

#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// Agents who coordinate choose from C(x), silent agents from IND_C(x), for as many steps as the delay.
[[nodiscard]] std::vector<AnswerPolicy> layer_policies(const ProblemSpec& spec);

}  // namespace coordreq

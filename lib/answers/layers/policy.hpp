#pragma once

#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// Agents who coordinate choose from C(x), those who are silent from IND_C(x), for as long as the delay is.
[[nodiscard]] std::vector<AnswerPolicy> layer_policies(const ProblemSpec& spec);

}  // namespace coordreq

#pragma once

#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// Agents who act by rules while they are silent: each class chooses from its A_c(x), at every countdown
/// (contract, section 9). None if the spec does not say what silent agents do.
[[nodiscard]] std::vector<AnswerPolicy> silence_policies(const ProblemSpec& spec);

/// The policy of `then`, when silence does not end. @pre unchecked: the spec has `then`
[[nodiscard]] AnswerPolicy afterwards_policy();

}  // namespace coordreq

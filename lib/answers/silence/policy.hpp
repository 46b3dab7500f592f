#pragma once

#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// Agents who do what they are told while they are silent: each class from its A_c(x), whatever is left of
/// the time (contract, section 9). None if the spec does not say what silent agents do.
[[nodiscard]] std::vector<AnswerPolicy> silence_policies(const ProblemSpec& spec);

/// And what they do for ever when silence does not end. @pre unchecked: the spec has `then`
[[nodiscard]] AnswerPolicy afterwards_policy();

}  // namespace coordreq

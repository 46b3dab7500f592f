#pragma once

#include <vector>

#include "answers/one_cell/explain_context.hpp"
#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// The actions that the convention leaves to each agent, which needs no coordination at all: on the way to a
/// goal in P(x), else in C(x).
[[nodiscard]] AnswerPolicy convention_policy();
/// Explains how many of its actions each agent would keep, and that it could be silent for ever.
[[nodiscard]] Explained explain_convention(const ExplainContext& context);
/// None unless the spec asks for a convention.
[[nodiscard]] std::vector<AnswerPolicy> convention_policies(const ProblemSpec& spec);

}  // namespace coordreq

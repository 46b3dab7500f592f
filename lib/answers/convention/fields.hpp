#pragma once

#include "answers/field.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kConventionFreedom[] = "/convention_freedom";
/// What an agent may do by convention. No partition can be called "convention" with a colon before it.
[[nodiscard]] std::string convention(const AgentSpec& agent);

}  // namespace paths

/// How free the convention leaves each agent; on request what it may do.
[[nodiscard]] Fields convention_fields(const ProblemSpec& spec);

}  // namespace coordreq

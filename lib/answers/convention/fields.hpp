#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kConventionFreedom[] = "/convention_freedom";
/// What an agent may do by convention. No partition can be called "convention" with a colon before it.
[[nodiscard]] std::string convention(const AgentSpec& agent);

}  // namespace paths

/// How free the convention leaves each agent; on request what it may do.
[[nodiscard]] Fields convention_fields(const ProblemSpec& spec);

/// What was found for them. The arrays refer to the answers, which must outlive the writing.
void fill_convention_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

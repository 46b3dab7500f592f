#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kConventionFreedom[] = "/convention_freedom";
/// The actions of an agent under the convention. No partition can have a name like this, with a colon.
[[nodiscard]] std::string convention(const AgentSpec& agent);

}  // namespace paths

/// The freedom of each agent under the convention; on request its actions.
[[nodiscard]] Fields convention_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_convention_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

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

}  // namespace coordreq

#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kCoalition[] = "/coalition";
inline constexpr char kCriticalPair[] = "/critical_pair";

}  // namespace paths

/// The names of the pairs of agents in the file, in their order: "a+b".
[[nodiscard]] std::vector<std::string> pair_names(const ProblemSpec& spec);

}  // namespace coordreq

#pragma once

#include <string>

#include "support/random_problem.hpp"

namespace coordreq {

/// A random spec of two to four agents, each moving a state of its own, with partitions in between all alone
/// and all together; drawn inside a RapidCheck property.
[[nodiscard]] std::string draw_team();

/// The spec with two random requirements, of any kind but `max_risk`, whose regions meet its grid; half of
/// the time with a goal. Agents of limited sight are asked for `min_blind_delay`,
/// too, and those who are told what to do for `min_silence`.
[[nodiscard]] std::string with_requirements(std::string text);

}  // namespace coordreq

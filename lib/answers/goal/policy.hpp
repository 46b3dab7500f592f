#pragma once

#include <memory>
#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// On the way to the goal (contract, section 5), in W \ G: agents choose from P(x) and IND_P(x), for as long
/// as the approach delay is. None without a goal.
[[nodiscard]] std::vector<AnswerPolicy> goal_policies(const ProblemSpec& spec);
/// @pre unchecked: there is a goal
[[nodiscard]] std::unique_ptr<CellPolicy> make_goal_policy(const PolicyGround& ground);

}  // namespace coordreq

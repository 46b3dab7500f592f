#pragma once

#include <memory>
#include <vector>

#include "answers/one_cell/policy.hpp"

namespace coordreq {

/// On the way to the goal (contract, section 5), in W \ G: agents who coordinate choose from P(x), silent
/// agents from IND_P(x), for as many steps as the approach delay. Of a lasting goal (section 11) in W. None
/// without a goal.
[[nodiscard]] std::vector<AnswerPolicy> goal_policies(const ProblemSpec& spec);
/// @pre unchecked: there is a goal
[[nodiscard]] std::unique_ptr<CellPolicy> make_goal_policy(const PolicyContext& context);

}  // namespace coordreq

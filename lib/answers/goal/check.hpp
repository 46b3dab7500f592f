#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks arrivals, approach delays and their triggers by their local equations: the equation of arrival has
/// exactly one solution, so that arrivals which obey it everywhere are right; and the cells of the goal, by
/// an evaluation of its own. Null without a goal.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_goal(const CheckContext& context);

}  // namespace coordreq

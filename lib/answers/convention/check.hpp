#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the convention of one cell after the other, from C(x) by its definition: from the lowest-numbered
/// joint input on, agents in order add their actions, ascending, as long as the product stays in C(x). Where
/// C(x) is perhaps larger than that of the analysis, another convention is wrong only where it leaves C(x).
/// @returns null: the spec asks for none
[[nodiscard]] std::unique_ptr<AnswerCheck> check_convention(const CheckContext& context);

}  // namespace coordreq

#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks what is said of the probability to leave K, with posts and arithmetic of the check's own (doubles,
/// whose roundings are allowed for):
/// - 1 outside K, and for every cell of K and mode T(V) <= V + rate, T being one more step (see find_risk()).
///   As V is nowhere below V_0, and T is monotone and T(v + c) <= T(v) + c, the risk within any n steps is
///   then at most V + n rate;
/// - CheckGround::is_full: V is V_N, worked out in N passes over all cells: not below it, and no more above
///   it than 0.1 % + 1e-30.
/// @returns null: the spec asks for no risk
[[nodiscard]] std::unique_ptr<AnswerCheck> check_risk(const CheckGround& ground);

/// What follows V in each mode.
[[nodiscard]] double risk_check_memory(const ProblemSpec& spec);

}  // namespace coordreq

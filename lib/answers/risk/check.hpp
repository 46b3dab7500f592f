#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the probability to leave K, with posts and arithmetic of its own (doubles, whose roundings are
/// allowed for):
/// - 1 outside K, and for every cell of K and mode T(V) <= V + rate, T being one more step (see find_risk()).
///   As V is nowhere below V_0, and T is monotone and T(v + c) <= T(v) + c, the risk within any n steps is
///   then at most V + n rate;
/// - CheckContext::is_full: V is V_N, computed in N passes over all cells: not below it, and at most 0.1 % +
///   1e-30 above it.
/// @returns null: the spec asks for no risk
[[nodiscard]] std::unique_ptr<AnswerCheck> check_risk(const CheckContext& context);

/// Bytes a cell: ranks and expected risks, for each mode.
[[nodiscard]] double risk_check_memory(const ProblemSpec& spec);

}  // namespace coordreq

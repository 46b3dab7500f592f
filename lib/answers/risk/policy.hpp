#pragma once

#include <string>

#include "answers/one_cell/policy.hpp"

namespace coordreq {
namespace paths {

// What the policy below asks of a cell, in one mode: not in a results file, but worked out from it. Bits of
// float32, which for numbers that are not negative have the same order.
inline constexpr char kRiskAfter[] = "/risk:after";  ///< E_q V_N, rounded up
inline constexpr char kRiskMost[] = "/risk:most";    ///< V_N + rate, rounded down

}  // namespace paths

/// What agents who are all connected choose from, without a clock, to be as safe as V_N + n rate says
/// (contract, section 10): the u in C(x) with max over y in f(x,u) of E_q V_N(y,.) <= V_N(x,q) + rate.
/// Roundings may leave none of them; then those of the least risk.
/// @param delay the path of the delays
[[nodiscard]] AnswerPolicy safest_policy(const std::string& delay);

}  // namespace coordreq

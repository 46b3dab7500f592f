#pragma once

#include <string>

#include "answers/one_cell/policy.hpp"

namespace coordreq {
namespace paths {

// Values of cells for the policy below, in one mode: computed from a results file. Bits of float32, which for
// numbers that are not negative have the same order.
inline constexpr char kRiskAfter[] = "/risk:after";  ///< E_q V_N, rounded up
inline constexpr char kRiskMost[] = "/risk:most";    ///< V_N + rate, rounded down

}  // namespace paths

/// The choices of agents who are all connected, without a clock, that are as safe as V_N + n rate (contract,
/// section 10): the u in C(x) with max over y in f(x,u) of E_q V_N(y,.) <= V_N(x,q) + rate. Roundings may
/// leave none; then the u of least risk.
/// @param delay the path of the delays
[[nodiscard]] AnswerPolicy safest_policy(const std::string& delay);

}  // namespace coordreq

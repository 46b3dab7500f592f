#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kRisk[] = "/risk";
inline constexpr char kDrawnRisk[] = "/risk_drawn";  ///< where the mode of the first step is drawn

}  // namespace paths

/// The probability to leave K from each cell, in each mode of the network; and before the mode of the first
/// step is drawn.
[[nodiscard]] Fields risk_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_risk_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

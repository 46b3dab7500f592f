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

}  // namespace coordreq

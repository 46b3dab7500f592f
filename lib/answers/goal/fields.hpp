#pragma once

#include <cstdint>

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kArrival[] = "/arrival";
inline constexpr char kApproachDelay[] = "/approach_delay";
inline constexpr char kApproachTrigger[] = "/approach_trigger";
/// The progress controller, on request.
inline constexpr char kProgress[] = "/controller:goal";

}  // namespace paths

/// Approach delay of a cell in K from which the goal cannot be forced.
inline constexpr std::int32_t kOutsideWinning = -4;

/// Arrival, approach delays and triggers, sizes of approach layers, F; on request the progress controller and
/// its projections on the classes. None without a goal.
[[nodiscard]] Fields goal_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_goal_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

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

}  // namespace coordreq

#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

// The fields that all answers depend on, so that readers may know them by name.
inline constexpr char kSafe[] = "/safe";
inline constexpr char kInvariant[] = "/invariant";
inline constexpr char kCollisionTime[] = "/collision_time";

inline constexpr char kController[] = "/controller";
/// The pairs of `controller.file`. No state can have this name.
inline constexpr char kListed[] = "/controller:file";

}  // namespace paths

}  // namespace coordreq

#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

// What all answers stand on, so that readers may know it by name.
inline constexpr char kSafe[] = "/safe";
inline constexpr char kInvariant[] = "/invariant";
inline constexpr char kCollisionTime[] = "/collision_time";

inline constexpr char kController[] = "/controller";
/// The pairs of `controller.file`. No state can have this name.
inline constexpr char kListed[] = "/controller:file";

}  // namespace paths

/// S, K and collision times; on request C(x), and what `controller.file` lists.
[[nodiscard]] Fields invariance_fields(const ProblemSpec& spec);

/// What was found for them. The arrays refer to the answers, which must outlive the writing.
void fill_invariance_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

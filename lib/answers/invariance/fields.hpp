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

/// S, K and collision times; on request C(x), and the pairs that `controller.file` lists.
[[nodiscard]] Fields invariance_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_invariance_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

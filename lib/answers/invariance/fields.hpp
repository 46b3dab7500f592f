#pragma once

#include "answers/field.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kController[] = "/controller";
/// The pairs of `controller.file`. No state can have this name.
inline constexpr char kListed[] = "/controller:file";

}  // namespace paths

/// S, K and collision times; on request C(x), and what `controller.file` lists.
[[nodiscard]] Fields invariance_fields(const ProblemSpec& spec);

}  // namespace coordreq

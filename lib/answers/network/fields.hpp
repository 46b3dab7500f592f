#pragma once

#include "answers/field.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kNetworkSafe[] = "/network_safe";

}  // namespace paths

/// Whether each mode of the network is safe from a cell.
[[nodiscard]] Fields network_fields(const ProblemSpec& spec);

}  // namespace coordreq

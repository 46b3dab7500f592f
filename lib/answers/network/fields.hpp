#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kNetworkSafe[] = "/network_safe";

}  // namespace paths

/// Whether each mode of the network is safe from a cell.
[[nodiscard]] Fields network_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_network_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

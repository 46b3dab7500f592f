#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kCoalition[] = "/coalition";
inline constexpr char kCriticalPair[] = "/critical_pair";

}  // namespace paths

/// Instead of a partition: no partition of the spec is enough.
inline constexpr std::int32_t kNoPartitionSuffices = -3;

/// The cheapest partition that is enough, and the pairs that cannot do without one another.
[[nodiscard]] Fields coalition_fields(const ProblemSpec& spec);
/// The names of the pairs of agents in the file, in their order: "a+b".
[[nodiscard]] std::vector<std::string> pair_names(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_coalition_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

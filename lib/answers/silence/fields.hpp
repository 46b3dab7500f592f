#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kSilence[] = "/silence";
inline constexpr char kSilenceSet[] = "/silence_set";

}  // namespace paths

/// Silence of all partitions, sizes of its layers, F, and K' if there is `then`. None if the spec does not
/// say what silent agents do.
[[nodiscard]] Fields silence_fields(const ProblemSpec& spec);

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_silence_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

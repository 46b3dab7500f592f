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

}  // namespace coordreq

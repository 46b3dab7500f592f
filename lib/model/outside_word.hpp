#pragma once

#include "spec/problem_spec.hpp"

namespace coordreq {

/// A rule for leaving the domain as the spec has it: "saturate".
[[nodiscard]] const char* outside_word(Outside rule);

}  // namespace coordreq

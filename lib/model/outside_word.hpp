#pragma once

#include "spec/spec_types.hpp"

namespace coordreq {

/// A rule for leaving the domain as the spec has it: "saturate".
[[nodiscard]] const char* outside_word(Outside rule);

}  // namespace coordreq

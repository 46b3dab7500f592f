#pragma once

#include "app/commands/all.hpp"

namespace coordreq {

/// What the user asked for, read and checked. Help and version are commands too: they print and succeed.
/// @throws UsageError saying what was found and what was expected
[[nodiscard]] Run parse_command_line(int argc, const char* const* argv);

}  // namespace coordreq

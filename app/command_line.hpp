#pragma once

#include <string>

#include "app/commands/all.hpp"

namespace coordreq {

/// What the user asked for, read and checked. Help and version are commands too: they print and succeed.
/// @throws UsageError saying what was found and what was expected
[[nodiscard]] Run parse_command_line(int argc, const char* const* argv);

/// What `--help` of a command prints, or that of the program for an empty name.
/// @throws UsageError if there is no such command
[[nodiscard]] std::string help_text(const std::string& command);

}  // namespace coordreq

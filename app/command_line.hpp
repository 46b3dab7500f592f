#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>

#include "app/commands/all.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {

/// A program with commands.
struct ProgramInfo {
  const char* name;
  const char* description;
  std::array<const char*, 2> examples;  ///< lines for a shell
  std::span<const CommandInfo> commands;
  std::function<void(const std::string&)> write = write_output;  ///< prints help and version
};

/// coordreq itself.
[[nodiscard]] ProgramInfo coordreq_program();

/// The command that the user typed, read and checked. Help and version are commands too: they print and
/// succeed.
/// @throws UsageError saying what was found and what was expected
[[nodiscard]] Run parse_command_line(int argc, const char* const* argv,
                                     const ProgramInfo& program = coordreq_program());

/// The text of `--help` of a command, or of the program for an empty name.
/// @throws UsageError if there is no such command
[[nodiscard]] std::string help_text(const std::string& command);

}  // namespace coordreq

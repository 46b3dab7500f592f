#pragma once

#include <string>

#include "app/command_options.hpp"

namespace coordreq {

/// @throws UsageError for no name, and for "-"
[[nodiscard]] std::string file_name(const std::string& text, const std::string& option);

/// The arguments of a command as what they stand for. REQUIRES: the parser has accepted them.
/// @throws UsageError saying what was found and what was expected
[[nodiscard]] CommandLine checked_values(const RawArguments& raw, const CommandInfo& info,
                                         const CLI::App& command);

}  // namespace coordreq

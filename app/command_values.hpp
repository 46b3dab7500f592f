#pragma once

#include "app/command_options.hpp"

namespace coordreq {

/// The arguments of a command as what they stand for. REQUIRES: the parser has accepted them.
/// @throws UsageError saying what was found and what was expected
[[nodiscard]] CommandLine checked_values(const RawArguments& raw, const CommandInfo& info,
                                         const CLI::App& command);

}  // namespace coordreq

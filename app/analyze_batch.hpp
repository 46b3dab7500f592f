#pragma once

#include "app/command_line.hpp"

namespace coordreq {

/// Whether there is more than one analysis to do, or a table of one is asked for.
[[nodiscard]] bool is_batch(const CommandLine& line);

/// `analyze` of several specs, or with swept values: one analysis after the other, a line each. One that
/// fails does not stop the others.
/// @returns the largest exit code of them. @throws as plan_runs(); IoError
[[nodiscard]] ExitCode run_analyze_batch(const CommandLine& line);

}  // namespace coordreq

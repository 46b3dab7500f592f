#pragma once

#include "app/analyze_options.hpp"

namespace coordreq {

/// `analyze` of several specs, or with swept values: one analysis after the other, a line each. One that
/// fails does not stop the others.
/// @returns the largest exit code of them. @throws as plan_runs(); IoError
[[nodiscard]] ExitCode run_analyze_batch(const AnalyzeOptions& asked);

}  // namespace coordreq

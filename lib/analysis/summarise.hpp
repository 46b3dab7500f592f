#pragma once

#include "analysis/analyze.hpp"
#include "analysis/solution.hpp"

namespace coordreq {

/// The summary of a solution, but for what only the run as a whole knows: output, threads, seconds, memory.
[[nodiscard]] AnalysisSummary summarise(const Solution& solution);

}  // namespace coordreq

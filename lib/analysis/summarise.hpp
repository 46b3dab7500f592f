#pragma once

#include "analysis/analyze.hpp"
#include "answers/answers.hpp"

namespace coordreq {

/// The summary of an analysis, but for what only the run as a whole knows: output, threads, seconds, memory.
[[nodiscard]] AnalysisSummary summarise(const Answers& answers);

}  // namespace coordreq

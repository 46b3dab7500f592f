#pragma once

#include "app/analyze_batch.hpp"

namespace coordreq {

/// Several analyses on ranks, each by one of them: whoever has done one gets the next. The first rank plans,
/// tells and works too. Together.
/// @throws as run_analyze_batch()
[[nodiscard]] ExitCode run_batch_on_ranks(const AnalyzeOptions& asked);

}  // namespace coordreq

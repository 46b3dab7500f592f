#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analyze.hpp"
#include "app/batch_plan.hpp"

namespace coordreq {

/// What has become of a run.
struct FinishedRun {
  PlannedRun plan;
  std::optional<AnalysisSummary> summary;  ///< none if it failed
  std::optional<Failure> failure;
  int exit_code = 0;
};

/// The largest exit code of the runs.
[[nodiscard]] int worst_exit_code(const std::vector<FinishedRun>& runs);

/// A line a run. REQUIRES: a run.
[[nodiscard]] std::string batch_text(const std::vector<FinishedRun>& runs, const CommandLine& line);

/// One document: every run with its summary, as `analyze --json` prints it, or its error.
[[nodiscard]] std::string batch_json(const std::vector<FinishedRun>& runs);

}  // namespace coordreq

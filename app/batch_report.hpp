#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/answers/all.hpp"
#include "app/batch_plan.hpp"
#include "app/text.hpp"
#include "base/json.hpp"

namespace coordreq {

/// The outcome of a run.
struct RunOutcome {
  std::shared_ptr<const Json> summary;  ///< none if it failed
  std::optional<Failure> failure;
  int exit_code = 0;
};

struct FinishedRun : RunOutcome {
  const PlannedRun* plan = nullptr;
};

/// The largest exit code of the runs.
[[nodiscard]] int worst_exit_code(const std::vector<FinishedRun>& runs);

/// The table of the runs, which is printed line by line as they end: columns are as wide as their figures can
/// be, as far as that is known beforehand.
class BatchTable {
 public:
  BatchTable(const std::vector<PlannedRun>& runs, const AnalyzeOptions& args);

  [[nodiscard]] std::string heading() const { return table_.text(); }
  [[nodiscard]] std::string row(const FinishedRun& run) const;

 private:
  bool has_path_;
  RunFigures more_;  ///< columns that only some specs have
  Table table_;
};

/// Each requirement that fails, once, with a line for the reason in each of the first runs in which it does.
[[nodiscard]] std::string failures_text(const std::vector<FinishedRun>& runs);

/// Where the results are.
[[nodiscard]] std::string closing_text(const std::vector<FinishedRun>& runs, const AnalyzeOptions& args);

/// One document: every run with its summary, as `analyze --json` prints it, or its error.
[[nodiscard]] std::string batch_json(const std::vector<FinishedRun>& runs);

}  // namespace coordreq

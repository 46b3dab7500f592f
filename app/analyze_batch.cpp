#include "app/analyze_batch.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/analyze_run.hpp"
#include "app/batch_plan.hpp"
#include "app/batch_report.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/print_warnings.hpp"
#include "app/standard_streams.hpp"
#include "base/timer.hpp"

namespace coordreq {
namespace {

void analyze_into(FinishedRun& run, const AnalyzeOptions& asked, const std::string& prefix) {
  reset_peak_memory();
  try {
    run.summary = analyze_with_progress(*run.plan.spec, run.plan.output, asked, prefix);
    run.exit_code = static_cast<int>(verdict(*run.summary));
  } catch (...) {
    run.failure = describe_current_exception();
  }
}

FinishedRun finish(PlannedRun plan, const AnalyzeOptions& asked, const std::string& prefix,
                   PrintedWarnings& warnings) {
  FinishedRun run{.plan = std::move(plan)};
  run.failure = run.plan.failure;
  if (run.plan.spec) analyze_into(run, asked, prefix);
  if (run.failure) run.exit_code = run.failure->exit_code;
  if (is_interrupted() || run.exit_code == static_cast<int>(ExitCode::interrupted)) {
    throw Error(ExitCode::interrupted, "interrupted", run_label(run.plan));
  }
  if (run.failure) report_failure(run_label(run.plan), *run.failure);
  if (run.summary) warnings.print((*run.summary)["warnings"], run_label(run.plan));
  return run;
}

void write_report(const std::string& path, const std::vector<FinishedRun>& runs) {
  std::vector<JunitSuite> suites;
  for (const FinishedRun& run : runs) {
    suites.push_back({.name = run_name(run.plan)});
    if (run.failure) suites.back().error = run.failure->what;
    if (!run.summary) continue;
    suites.back().summary = &*run.summary;
    suites.back().spec = &*run.plan.spec;
  }
  const InterruptDelay delay;
  write_junit(path, suites);
  check_interrupted(path);
}

}  // namespace

ExitCode run_analyze_batch(const AnalyzeOptions& asked) {
  std::vector<PlannedRun> plan = plan_runs(asked);
  if (asked.checkpoint)
    throw UsageError(fmt::format("expected one analysis, found {}", plan.size()), "--checkpoint");
  if (asked.junit) try_to_write(*asked.junit);
  const BatchTable table(plan, asked);
  const bool is_text = !asked.json && !asked.quiet;
  if (is_text) write_output(table.heading());
  std::vector<FinishedRun> runs;
  PrintedWarnings warnings(asked);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const std::string prefix = fmt::format("{} of {}, ", i + 1, plan.size());
    runs.push_back(finish(std::move(plan[i]), asked, prefix, warnings));
    if (is_text) write_output(table.row(runs.back()));
  }
  if (asked.junit) write_report(*asked.junit, runs);
  if (is_text) write_output(closing_text(runs, asked));
  if (asked.json) write_output(batch_json(runs));
  return static_cast<ExitCode>(worst_exit_code(runs));
}

}  // namespace coordreq

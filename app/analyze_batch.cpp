#include "app/analyze_batch.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/analyze_run.hpp"
#include "app/batch_plan.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/print.hpp"
#include "app/standard_streams.hpp"
#include "base/timer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void fail_if_interrupted(int exit_code, const std::string& place) {
  if (is_interrupted() || exit_code == static_cast<int>(ExitCode::interrupted))
    throw Error(ExitCode::interrupted, "interrupted", place);
}

/// Tells of runs in the order of the plan, whenever they end.
class Results {
 public:
  /// @pre unchecked: `plan` outlives this object.
  Results(const std::vector<PlannedRun>& plan, const AnalyzeOptions& asked)
      : table_(plan, asked), is_text_(!asked.json && !asked.quiet), warnings_(asked) {
    if (is_text_) write_output(table_.heading());
    for (const PlannedRun& planned : plan) {
      FinishedRun& run = runs_.emplace_back();
      run.failure = planned.failure;
      run.plan = &planned;
      is_done_.push_back(!planned.spec);
    }
    tell();
  }

  void take(std::size_t i, RunOutcome outcome) {
    static_cast<RunOutcome&>(runs_[i]) = std::move(outcome);
    is_done_[i] = true;
    tell();
  }

  [[nodiscard]] const std::vector<FinishedRun>& runs() const { return runs_; }

 private:
  void tell() {
    for (; told_ < runs_.size() && is_done_[told_]; ++told_) {
      FinishedRun& run = runs_[told_];
      if (run.failure) run.exit_code = run.failure->exit_code;
      fail_if_interrupted(run.exit_code, run_label(*run.plan));
      if (run.failure) report_failure(run_label(*run.plan), *run.failure);
      if (run.summary) warnings_.print((*run.summary)["warnings"], run_label(*run.plan));
      if (is_text_) write_output(table_.row(run));
    }
  }

  BatchTable table_;
  bool is_text_;
  PrintedWarnings warnings_;
  std::vector<FinishedRun> runs_;
  std::vector<bool> is_done_;
  std::size_t told_ = 0;
};

void write_report(const std::string& path, const std::vector<FinishedRun>& runs) {
  std::vector<JunitSuite> suites;
  for (const FinishedRun& run : runs) {
    suites.push_back({.name = run_name(*run.plan)});
    if (run.failure) suites.back().error = run.failure->what;
    if (!run.summary) continue;
    suites.back().summary = &*run.summary;
    suites.back().spec = &*run.plan->spec;
  }
  const InterruptDelay delay;
  write_junit(path, suites);
  check_interrupted(path);
}

}  // namespace

RunOutcome outcome_of(const ProblemSpec& spec, const std::string& output, const AnalyzeOptions& asked,
                      const std::string& prefix) {
  RunOutcome outcome;
  reset_peak_memory();
  try {
    outcome.summary = analyze_with_progress(spec, output, asked, prefix);
    outcome.exit_code = static_cast<int>(verdict(*outcome.summary));
  } catch (...) {
    outcome.failure = describe_current_exception();
    outcome.exit_code = outcome.failure->exit_code;
  }
  return outcome;
}

void one_after_the_other(const std::vector<PlannedRun>& plan, const AnalyzeOptions& asked,
                         const std::function<void(std::size_t, RunOutcome)>& done) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (!plan[i].spec) continue;
    const std::string prefix = fmt::format("{} of {}, ", i + 1, plan.size());
    done(i, outcome_of(*plan[i].spec, plan[i].output, asked, prefix));
  }
}

ExitCode run_analyze_batch(const AnalyzeOptions& asked, const BatchWork& work) {
  const std::vector<PlannedRun> plan = plan_runs(asked);
  if (asked.checkpoint)
    throw UsageError(fmt::format("expected one analysis, found {}", plan.size()), "--checkpoint");
  if (asked.junit) try_to_write(*asked.junit);
  Results results(plan, asked);
  work(plan, asked,
       [&results](std::size_t run, RunOutcome outcome) { results.take(run, std::move(outcome)); });
  const std::vector<FinishedRun>& runs = results.runs();
  if (asked.junit) write_report(*asked.junit, runs);
  if (!asked.json && !asked.quiet) write_output(failures_text(runs) + closing_text(runs, asked));
  if (asked.json) write_output(batch_json(runs));
  return static_cast<ExitCode>(worst_exit_code(runs));
}

}  // namespace coordreq

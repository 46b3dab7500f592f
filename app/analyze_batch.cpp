#include "app/analyze_batch.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
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

void fail_if_interrupted(int exit_code, const std::string& location) {
  if (is_interrupted() || exit_code == static_cast<int>(ExitCode::interrupted))
    throw Error(ExitCode::interrupted, "interrupted", location);
}

/// Reports runs in the order of the plan, whenever they end.
class Results {
 public:
  /// @pre unchecked: `plan` outlives this object.
  Results(const std::vector<PlannedRun>& plan, const AnalyzeOptions& args)
      : table_(plan, args), is_text_(!args.json && !args.quiet), warnings_(args) {
    if (is_text_) write_output(table_.heading());
    for (const PlannedRun& planned : plan) {
      FinishedRun& run = runs_.emplace_back();
      run.failure = planned.failure;
      run.plan = &planned;
      is_done_.push_back(!planned.spec);
    }
    report_finished();
  }

  void take(std::size_t i, RunOutcome outcome) {
    static_cast<RunOutcome&>(runs_[i]) = std::move(outcome);
    is_done_[i] = true;
    report_finished();
  }

  [[nodiscard]] const std::vector<FinishedRun>& runs() const { return runs_; }

 private:
  void report_finished() {
    for (; reported_ < runs_.size() && is_done_[reported_]; ++reported_) {
      FinishedRun& run = runs_[reported_];
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
  std::size_t reported_ = 0;
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

RunOutcome outcome_of(const ProblemSpec& spec, const std::string& output, const AnalyzeOptions& args,
                      const std::string& prefix) {
  RunOutcome outcome;
  reset_peak_memory();
  try {
    outcome.summary = analyze_with_progress(spec, output, args, prefix);
    outcome.exit_code = static_cast<int>(verdict(*outcome.summary));
  } catch (...) {
    outcome.failure = describe_current_exception();
    outcome.exit_code = outcome.failure->exit_code;
  }
  return outcome;
}

void one_after_the_other(const std::vector<PlannedRun>& plan, const AnalyzeOptions& args,
                         const std::function<void(std::size_t, RunOutcome)>& done) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (!plan[i].spec) continue;
    const std::string prefix = fmt::format("{} of {}, ", i + 1, plan.size());
    done(i, outcome_of(*plan[i].spec, plan[i].output, args, prefix));
  }
}

ExitCode run_analyze_batch(const AnalyzeOptions& args, const BatchWork& work) {
  const std::vector<PlannedRun> plan = plan_runs(args);
  if (args.checkpoint)
    throw UsageError(fmt::format("expected one analysis, found {}", plan.size()), "--checkpoint");
  if (args.junit) try_to_write(*args.junit);
  Results results(plan, args);
  work(plan, args,
       [&results](std::size_t run, RunOutcome outcome) { results.take(run, std::move(outcome)); });
  const std::vector<FinishedRun>& runs = results.runs();
  if (args.junit) write_report(*args.junit, runs);
  if (!args.json && !args.quiet) write_output(failures_text(runs) + closing_text(runs, args));
  if (args.json) write_output(batch_json(runs));
  return static_cast<ExitCode>(worst_exit_code(runs));
}

}  // namespace coordreq

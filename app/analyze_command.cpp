#include "analysis/analyze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/analyze_report.hpp"
#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/load_spec.hpp"
#include "app/memory_limit.hpp"
#include "app/progress_display.hpp"
#include "app/standard_streams.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

/// Lets a signal end the program at once while there is no temporary file, and as soon as it hears of the
/// work's progress otherwise.
class InterruptPolicy {
 public:
  // The first thing an analysis does is to try whether it can write.
  InterruptPolicy() { delay_.emplace(); }

  void obey(const Progress& progress) {
    if (progress.has_temporary && !delay_) delay_.emplace();
    if (!progress.has_temporary) delay_.reset();
    // After that: one that came before the end of the delay has been kept waiting.
    if (is_interrupted()) throw Error(ExitCode::interrupted, "interrupted", "");
  }

 private:
  std::optional<InterruptDelay> delay_;
};

bool is_same_file(const std::string& a, const std::string& b) {
  using std::filesystem::absolute, std::filesystem::weakly_canonical;
  return weakly_canonical(absolute(a)) == weakly_canonical(absolute(b));
}

/// Files that would take the place of one another.
void check_files(const AnalysisOptions& options, const CommandLine& line) {
  if (line.junit && is_same_file(*line.junit, options.output)) {
    throw UsageError(fmt::format("expected another file than the results, found '{}'", *line.junit),
                     "--junit");
  }
  if (!line.checkpoint) return;
  const std::string& file = line.checkpoint->file;
  if (is_same_file(file, options.output) || (line.junit && is_same_file(file, *line.junit)))
    throw UsageError(fmt::format("expected a file of its own, found '{}'", file), "--checkpoint");
}

AnalysisSummary analyze_with_progress(const ProblemSpec& spec, const CommandLine& line) {
  InterruptPolicy interrupts;
  ProgressDisplay shown(line.progress, line.quiet);
  AnalysisOptions options;
  options.output = line.output.value_or(spec.name + ".h5");
  options.max_memory = line.max_memory ? line.max_memory : available_memory();
  options.checkpoint = line.checkpoint;
  options.progress = [&shown, &interrupts](const Progress& progress) {
    interrupts.obey(progress);
    shown.update(progress);
  };
  options.notice = [&shown, &line](const std::string& text) {
    if (!line.quiet) shown.notice(text);
  };
  ThreadTeam team(line.threads);
  check_files(options, line);
  if (line.junit) check_writable(*line.junit);
  AnalysisSummary summary = analyze(spec, options, team);
  shown.finish();
  if (line.junit) write_junit(*line.junit, summary, spec);
  if (is_interrupted()) {
    throw Error(ExitCode::interrupted, "interrupted when the results were complete", options.output);
  }
  return summary;
}

}  // namespace

ExitCode run_analyze(const CommandLine& line) {
  const ProblemSpec spec = load_spec(line.path);
  const AnalysisSummary summary = analyze_with_progress(spec, line);
  if (line.json) {
    write_output(summary_json(summary, spec));
  } else if (!line.quiet) {
    write_output(summary_text(summary, spec));
  }
  const bool hold = std::all_of(summary.requirements.begin(), summary.requirements.end(),
                                [](const ResultRequirement& requirement) { return requirement.holds; });
  return hold ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace coordreq

#include <fmt/format.h>

#include "app/analyze_batch.hpp"
#include "app/analyze_report.hpp"
#include "app/analyze_run.hpp"
#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/load_spec.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
namespace {

/// Files that would take the place of one another.
void check_files(const std::string& output, const CommandLine& line) {
  if (line.junit && is_same_file(*line.junit, output)) {
    throw UsageError(fmt::format("expected another file than the results, found '{}'", *line.junit),
                     "--junit");
  }
  if (!line.checkpoint) return;
  const std::string& file = line.checkpoint->file;
  if (is_same_file(file, output) || (line.junit && is_same_file(file, *line.junit)))
    throw UsageError(fmt::format("expected a file of its own, found '{}'", file), "--checkpoint");
}

AnalysisSummary analyze_and_write(const ProblemSpec& spec, const CommandLine& line) {
  const std::string output = line.output.value_or(spec.name + ".h5");
  ThreadTeam team(line.threads);
  check_files(output, line);
  if (line.junit) try_to_write(*line.junit);
  AnalysisSummary summary = analyze_with_progress(spec, output, line, team, "");
  const InterruptDelay delay;
  if (line.junit) write_junit(*line.junit, {{.name = spec.name, .spec = &spec, .summary = &summary}});
  check_interrupted(output);
  return summary;
}

}  // namespace

ExitCode run_analyze(const CommandLine& line) {
  if (is_batch(line)) return run_analyze_batch(line);
  const ProblemSpec spec = load_spec(line.path, line.settings);
  const AnalysisSummary summary = analyze_and_write(spec, line);
  if (line.json) {
    write_output(json_text(summary_json(summary, spec)));
  } else if (!line.quiet) {
    write_output(summary_text(summary, spec));
  }
  return verdict(summary);
}

}  // namespace coordreq

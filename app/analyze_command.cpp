#include "app/analyze_batch.hpp"
#include "app/analyze_report.hpp"
#include "app/analyze_run.hpp"
#include "app/commands.hpp"
#include "app/files_in_use.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/load_spec.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
namespace {

/// @throws UsageError if a file would take the place of another
void check_files(const ProblemSpec& spec, const std::string& output, const CommandLine& line) {
  FilesInUse files;
  add_read_files(line.path, &spec, files);
  files.writes(output, "the results", "--output");
  if (line.junit) files.writes(*line.junit, "the JUnit report", "--junit");
  if (!line.checkpoint) return;
  for (const std::string& file : files_of(*line.checkpoint))
    files.writes(file, "the checkpoint", "--checkpoint");
}

AnalysisSummary analyze_and_write(const ProblemSpec& spec, const CommandLine& line) {
  const std::string output = line.output.value_or(spec.name + ".h5");
  ThreadTeam team(line.threads);
  check_files(spec, output, line);
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

#include "app/commands.hpp"
#include "app/compare_report.hpp"
#include "app/progress_display.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
namespace {

ResultsComparison compare_with_progress(const ResultsReader& before, const ResultsReader& after,
                                        CompareOptions options, const CommandLine& line) {
  ProgressDisplay shown(line.progress, line.quiet);
  options.progress = [&shown](const std::string& subject) {
    shown.update({.stage = "comparing " + subject});
  };
  ResultsComparison comparison = compare_results(before, after, options);
  shown.finish();
  return comparison;
}

}  // namespace

ExitCode run_compare(const CommandLine& line) {
  const ResultsReader before(line.paths[0], line.max_memory);
  const ResultsReader after(line.paths[1], line.max_memory);
  const CompareOptions options{.tolerance = line.tolerance, .worst = line.limit};
  const ResultsComparison comparison = compare_with_progress(before, after, options, line);
  if (line.json) {
    write_output(comparison_json(comparison, before, after, options));
  } else if (!line.quiet) {
    write_output(comparison_text(comparison, before, after, options));
  }
  return comparison.is_worse() ? ExitCode::requirement_failed : ExitCode::success;
}

}  // namespace coordreq

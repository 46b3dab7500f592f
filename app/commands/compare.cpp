#include <memory>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/progress_display.hpp"
#include "app/reports.hpp"

namespace coordreq {
namespace {

struct CompareArguments : CommonOptions {
  std::string before, after;
  CompareOptions compare{.tolerance = 0, .worst = 5};
  ProgressOptions progress;
};

ResultsComparison compare_with_progress(const ResultsReader& before, const ResultsReader& after,
                                        const CompareArguments& arguments) {
  ProgressDisplay display(arguments.progress, arguments.quiet);
  CompareOptions options = arguments.compare;
  options.progress = [&display](const std::string& subject) {
    display.update({.stage = "comparing " + subject});
  };
  ResultsComparison comparison = compare_results(before, after, options);
  display.finish();
  return comparison;
}

ExitCode run(const CompareArguments& arguments) {
  arguments.keep_to_memory();
  const ResultsReader before(arguments.before, arguments.max_memory);
  const ResultsReader after(arguments.after, arguments.max_memory);
  static_cast<void>(
      arguments.threads_for("comparing needs", {.once = before.reading_bytes() + after.reading_bytes()}));
  const ResultsComparison comparison = compare_with_progress(before, after, arguments);
  print_comparison(arguments, comparison, before, after, arguments.compare);
  return comparison.is_worse() ? ExitCode::requirement_failed : ExitCode::success;
}

}  // namespace

Run declare_compare(Options& options) {
  constexpr std::int64_t kMostSteps = 2'147'483'646;
  constexpr std::size_t kMostCells = 1'000'000;
  const auto arguments = std::make_shared<CompareArguments>();
  options.argument(arguments->before, "A", "The earlier results file", "RESULTS");
  options.argument(arguments->after, "B", "The later results file", "RESULTS");
  options.option(
      arguments->compare.tolerance, "--tolerance", "N",
      "Steps that a cell may lose, unless it leaves the invariance set or was unbounded (default: 0)",
      WholeNumber<std::int64_t>{0, kMostSteps});
  options.option(arguments->compare.worst, "--limit", "N", "Cells to name for each partition (default: 5)",
                 WholeNumber<std::size_t>{0, kMostCells});
  declare_progress(options, arguments->progress);
  declare_common(options, *arguments, {.threads = false});
  return [arguments] { return run(*arguments); };
}

}  // namespace coordreq

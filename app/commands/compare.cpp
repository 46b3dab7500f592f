#include <memory>

#include "app/commands/all.hpp"
#include "app/compare_report.hpp"
#include "app/option_values.hpp"
#include "app/progress_display.hpp"

namespace coordreq {
namespace {

struct CompareArguments : CommonOptions {
  std::string before, after;
  CompareOptions compare{.tolerance = 0, .worst = 5};
  ProgressOptions progress;
};

ResultsComparison compare_with_progress(const ResultsReader& before, const ResultsReader& after,
                                        const CompareArguments& own) {
  ProgressDisplay shown(own.progress, own.quiet);
  CompareOptions options = own.compare;
  options.progress = [&shown](const std::string& subject) {
    shown.update({.stage = "comparing " + subject});
  };
  ResultsComparison comparison = compare_results(before, after, options);
  shown.finish();
  return comparison;
}

ExitCode run(const CompareArguments& own) {
  own.keep_to_memory();
  const ResultsReader before(own.before, own.max_memory);
  const ResultsReader after(own.after, own.max_memory);
  static_cast<void>(
      own.threads_for("comparing needs", {.once = before.reading_bytes() + after.reading_bytes()}));
  const ResultsComparison comparison = compare_with_progress(before, after, own);
  print_comparison(own, comparison, before, after, own.compare);
  return comparison.is_worse() ? ExitCode::requirement_failed : ExitCode::success;
}

}  // namespace

Run declare_compare(Options& options) {
  constexpr std::int64_t kMostSteps = 2'147'483'646;
  constexpr std::size_t kMostCells = 1'000'000;
  const auto own = std::make_shared<CompareArguments>();
  options.argument(own->before, "A", "The earlier results file", "RESULTS");
  options.argument(own->after, "B", "The later results file", "RESULTS");
  options.option(
      own->compare.tolerance, "--tolerance", "N",
      "Steps that a cell may lose, unless it leaves the invariance set or was unbounded (default: 0)",
      WholeNumber<std::int64_t>{0, kMostSteps});
  options.option(own->compare.worst, "--limit", "N", "Cells to name for each partition (default: 5)",
                 WholeNumber<std::size_t>{0, kMostCells});
  declare_progress(options, own->progress);
  declare_common(options, *own, {.threads = false});
  return [own] { return run(*own); };
}

}  // namespace coordreq

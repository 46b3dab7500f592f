#include "app/analyze_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "analysis/analyze.hpp"
#include "analysis/estimate_memory.hpp"
#include "analysis/estimate_seconds.hpp"
#include "app/files_in_use.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/load_spec.hpp"
#include "app/print.hpp"
#include "app/progress_display.hpp"
#include "app/reports.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "reach/build_abstraction.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Lets a signal end the program at once while there is no temporary file, and as soon as it notices the
/// work's progress otherwise.
class InterruptPolicy {
 public:
  // The first thing an analysis does is to try whether it can write.
  InterruptPolicy() { delay_.emplace(); }

  void obey(const Progress& progress) {
    if (progress.has_temporary && !delay_) delay_.emplace();
    if (!progress.has_temporary) delay_.reset();
    // After that: one that came before the end of the delay has been kept waiting. Once the results are
    // complete it is reported at the end, see check_interrupted().
    if (is_interrupted() && !progress.is_written) throw interruption();
  }

 private:
  std::optional<InterruptDelay> delay_;
};

/// Before work that will take hours it says so. What is known of that decides nothing.
void report_hours(const Model& model, ThreadTeam& team) {
  constexpr double kHour = 3600;
  if (!may_take_hours(model)) return;
  const std::optional<double> seconds = estimate_seconds(model, team);
  if (!seconds || *seconds < kHour) return;
  write_diagnostics(fmt::format(
      "coordreq: warning: {} will take about {} on {} thread{}; --checkpoint keeps what is done, and a "
      "coarser "
      "grid takes less\n",
      printable(model.spec().name), time_span(*seconds), team.size(), team.size() == 1 ? "" : "s"));
}

/// @throws UsageError if a file would replace another
void check_files(const ProblemSpec& spec, const std::string& output, const AnalyzeOptions& options) {
  FilesInUse files;
  add_read_files(options.specs.front(), &spec, files);
  files.writes(output, "the results", "--output");
  if (options.junit) files.writes(*options.junit, "the JUnit report", "--junit");
  if (options.checkpoint) files.writes(options.checkpoint->file, "the checkpoint", "--checkpoint");
}

}  // namespace

std::shared_ptr<const Json> analyze_with_progress(const ProblemSpec& spec, const std::string& output,
                                                  const AnalyzeOptions& args, const std::string& prefix) {
  const Model model = with_places_in(spec, [&] { return make_model(spec); });
  // Each of several processes knows only later which rows it holds.
  const bool is_alone = args.ranks == nullptr || args.ranks->count() == 1;
  ThreadTeam team(is_alone ? threads_within(model, args.memory(), args.threads, args.checkpoint.has_value())
                           : args.threads);
  if (is_alone && !args.quiet) report_hours(model, team);
  InterruptPolicy interrupts;
  ProgressDisplay display(args.progress, args.quiet);
  AnalysisOptions options;
  options.output = output;
  options.checkpoint = args.checkpoint;
  options.ranks = args.ranks;
  options.max_memory = args.memory();
  options.progress = [&](const Progress& progress) {
    interrupts.obey(progress);
    if (args.watch) args.watch();
    Progress of_many = progress;
    of_many.stage = prefix + progress.stage;
    display.update(of_many);
  };
  options.notice = [&](const std::string& text) {
    if (!args.quiet) display.notice(text);
  };
  Json summary = with_places_in(spec, [&] { return analyze(model, options, team); });
  display.finish();
  if (args.is_first() && verdict(summary) != ExitCode::success && std::filesystem::is_regular_file(output))
    summary = with_nearest_regions(summary, output);
  return std::make_shared<const Json>(std::move(summary));
}

void check_interrupted(const std::string& location) {
  if (is_interrupted()) {
    throw Error(ExitCode::interrupted, "interrupted when the results were complete", location);
  }
}

ExitCode analyze_and_print(const ProblemSpec& spec, const AnalyzeOptions& options) {
  const std::string output = options.output.value_or(spec.name + ".h5");
  if (options.is_first()) check_files(spec, output, options);
  if (options.is_first() && !options.output && !options.is_forced) check_replaces_own_results(output, spec);
  if (options.is_first() && options.junit) try_to_write(*options.junit);
  if (options.is_first() && options.checkpoint) {
    const bool is_folder = options.ranks != nullptr && options.ranks->count() > 1;
    note_checkpoint(options.checkpoint->file, is_folder);
  }
  const std::shared_ptr<const Json> summary = analyze_with_progress(spec, output, options, "");
  if (!options.is_first()) return ExitCode::success;
  {
    const InterruptDelay delay;
    if (options.junit)
      write_junit(*options.junit, {{.name = spec.name, .spec = &spec, .summary = summary.get()}});
    check_interrupted(output);
  }
  PrintedWarnings(options).print((*summary)["warnings"]);
  print_answer(options, *summary, [&spec](const Json& found) { return summary_text(found, spec); });
  return verdict(*summary);
}

void try_to_write(const std::string& path) {
  const InterruptDelay delay;  // while there is a temporary file
  check_writable(path);
}

ExitCode verdict(const Json& summary) {
  const Json& all = summary["requirements"];
  const bool hold =
      std::all_of(all.begin(), all.end(), [](const Json& entry) { return entry["holds"].get<bool>(); });
  return hold ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace coordreq

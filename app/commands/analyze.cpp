#include <memory>

#include "app/analysis_text.hpp"
#include "app/analyze_batch.hpp"
#include "app/analyze_options.hpp"
#include "app/analyze_run.hpp"
#include "app/commands/all.hpp"
#include "app/files_in_use.hpp"
#include "app/interrupt.hpp"
#include "app/junit_report.hpp"
#include "app/load_spec.hpp"
#include "app/memory_limit.hpp"
#include "app/option_values.hpp"
#include "app/print_answer.hpp"
#include "app/print_warnings.hpp"

namespace coordreq {
namespace {

/// @throws UsageError if a file would take the place of another
void check_files(const ProblemSpec& spec, const std::string& output, const AnalyzeOptions& own) {
  FilesInUse files;
  add_read_files(own.specs.front(), &spec, files);
  files.writes(output, "the results", "--output");
  if (own.junit) files.writes(*own.junit, "the JUnit report", "--junit");
  if (own.checkpoint) files.writes(own.checkpoint->file, "the checkpoint", "--checkpoint");
}

std::shared_ptr<const Json> analyze_and_write(const ProblemSpec& spec, const AnalyzeOptions& own) {
  const std::string output = own.output.value_or(spec.name + ".h5");
  check_files(spec, output, own);
  if (own.junit) try_to_write(*own.junit);
  std::shared_ptr<const Json> summary = analyze_with_progress(spec, output, own, "");
  const InterruptDelay delay;
  if (own.junit) write_junit(*own.junit, {{.name = spec.name, .spec = &spec, .summary = summary.get()}});
  check_interrupted(output);
  return summary;
}

ExitCode run(const AnalyzeOptions& own) {
  if (own.max_memory) hold_to_memory(*own.max_memory, own.threads);
  if (own.is_batch()) return run_analyze_batch(own);
  const ProblemSpec spec = load_spec(own.specs.front(), own.settings, own.memory());
  const std::shared_ptr<const Json> summary = analyze_and_write(spec, own);
  PrintedWarnings(own).print((*summary)["warnings"]);
  print_answer(own, *summary, [&spec](const Json& found) { return summary_text(found, spec); });
  return verdict(*summary);
}

/// The other two come after it, so that they can ask whether it was given.
void declare_checkpoint(Options& options, std::optional<CheckpointOptions>& checkpoint) {
  options.option("--checkpoint", "FILE",
                 "Save the work there now and then; removed when the results are written",
                 [&checkpoint](const auto& text, const auto& option) {
                   checkpoint = {.file = file_name(text, option)};
                 });
  options.option("--checkpoint-every", "SECONDS", "How often (default: 60)",
                 [&checkpoint](const auto& text, const auto& option) {
                   if (!checkpoint) throw UsageError("save where? expected --checkpoint FILE", option);
                   checkpoint->every_seconds = seconds(text, option);
                 });
  options.flag("--resume", "Continue from the checkpoint, if there is one", [&checkpoint] {
    if (!checkpoint) throw UsageError("resume from what? expected --checkpoint FILE", "--resume");
    checkpoint->resume = true;
  });
}

}  // namespace

Run declare_analyze(Options& options) {
  const auto own = std::make_shared<AnalyzeOptions>();
  options.arguments(own->specs, "SPEC", kSpecDescription);
  options.option(own->output, "-o,--output", "FILE",
                 "Results file (default: NAME.h5 in the current folder), or a folder for several", file_name);
  options.option(own->junit, "--junit", "FILE", "Also write the requirements as a JUnit report", file_name);
  declare_settings(options, own->settings);
  options.repeatable(
      own->sweeps, "--sweep", "PATH=VALUE,VALUE",
      "Analyse with each of these values and print a table, refine=1,2,4 with finer grids; repeated: "
      "with each combination; results files are only written with -o",
      parse_sweep);
  declare_checkpoint(options, own->checkpoint);
  declare_progress(options, own->progress);
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq

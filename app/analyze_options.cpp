#include "app/analyze_options.hpp"

#include <fmt/format.h>

#include "app/load_spec.hpp"
#include "app/option_values.hpp"

namespace coordreq {

void declare_files(Options& options, AnalyzeOptions& args) {
  options.option(args.output, "-o,--output", "FILE",
                 "Results file (default: NAME.h5 in the current folder), or a folder for several", file_name);
  options.flag(args.is_forced, "--force",
               "Replace a file of the name NAME.h5 also if it is not of this spec");
  options.option(args.junit, "--junit", "FILE", "Also write the requirements as a JUnit report", file_name);
  declare_settings(options, args.settings);
  options.repeatable(
      args.sweeps, "--sweep", "PATH=VALUE,VALUE",
      "Analyse once for each value and print a table; refine=1,2,4 gives finer grids; repeated: every "
      "combination; results files are written only with -o",
      parse_sweep);
}

/// The other two come after it, so that they can ask whether it was given.
void declare_checkpoint(Options& options, std::optional<CheckpointOptions>& checkpoint, const char* takes) {
  options.option("--checkpoint", takes,
                 "Save the work here regularly; removed when the results have been written",
                 [&checkpoint](const auto& text, const auto& option) {
                   checkpoint = {.file = file_name(text, option)};
                 });
  options.option("--checkpoint-every", "SECONDS", "Time between two saves (default: 60)",
                 [&checkpoint, takes](const auto& text, const auto& option) {
                   if (!checkpoint)
                     throw UsageError(fmt::format("save where? expected --checkpoint {}", takes), option);
                   checkpoint->every_seconds = seconds(text, option);
                 });
  options.flag("--resume", "Continue from the checkpoint, if there is one", [&checkpoint, takes] {
    if (!checkpoint)
      throw UsageError(fmt::format("resume from what? expected --checkpoint {}", takes), "--resume");
    checkpoint->resume = true;
  });
}

}  // namespace coordreq

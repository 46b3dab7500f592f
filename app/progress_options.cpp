#include "app/progress_display.hpp"

#include "app/option_values.hpp"
#include "base/error.hpp"

namespace coordreq {

void declare_progress(Options& options, ProgressOptions& progress) {
  options.option(
      progress.mode, "--progress", "auto|log|none",
      "auto: a bar on a terminal, otherwise one line per minute (none with --quiet); log: more lines "
      "(default: auto)",
      OneOf<ProgressMode>{
          {{"auto", ProgressMode::automatic}, {"log", ProgressMode::log}, {"none", ProgressMode::none}}});
  options.option("--progress-every", "SECONDS", "Time between two lines (default: 10 with log, otherwise 60)",
                 [&progress](const auto& text, const auto& option) {
                   if (progress.mode == ProgressMode::none)
                     throw UsageError("no lines are printed, expected --progress log", option);
                   progress.every_seconds = seconds(text, option);
                 });
}

}  // namespace coordreq

#include "app/progress_options.hpp"

#include "app/option_values.hpp"
#include "base/error.hpp"

namespace coordreq {

void declare_progress(Options& options, ProgressOptions& progress) {
  options.option(
      progress.mode, "--progress", "auto|log|none",
      "auto: a bar on a terminal, but for --quiet; log: lines (default: auto)",
      OneOf<ProgressMode>{
          {{"auto", ProgressMode::automatic}, {"log", ProgressMode::log}, {"none", ProgressMode::none}}});
  options.option("--progress-every", "SECONDS", "Between two lines of the log (default: 10)",
                 [&progress](const auto& text, const auto& option) {
                   if (progress.mode != ProgressMode::log)
                     throw UsageError("only a log has lines every so often, expected --progress log", option);
                   progress.every_seconds = seconds(text, option);
                 });
}

}  // namespace coordreq

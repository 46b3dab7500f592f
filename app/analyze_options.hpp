#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/checkpoint_options.hpp"
#include "app/options.hpp"
#include "app/progress_display.hpp"
#include "app/sweep.hpp"
#include "base/error.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// The command line of `analyze`.
struct AnalyzeOptions : CommonOptions {
  std::vector<std::string> specs;
  std::vector<SpecSetting> settings;
  std::vector<Sweep> sweeps;
  std::optional<std::string> output, junit;
  bool is_forced = false;  ///< files under default names are replaced, whatever they are
  ProgressOptions progress;
  std::optional<CheckpointOptions> checkpoint;
  Ranks* ranks = nullptr;  ///< the processes that share the work; null: there is one
  /// Called again and again while the work goes on; what it throws ends it. May be empty.
  std::function<void()> watch;

  /// Whether this process reads, writes and prints.
  [[nodiscard]] bool is_first() const { return ranks == nullptr || ranks->rank() == 0; }
  /// Whether there is more than one analysis to do, or a table of one was requested.
  [[nodiscard]] bool is_batch() const { return specs.size() > 1 || !sweeps.empty(); }
};

/// --output, --junit, --set, --refine and --sweep.
void declare_files(Options& options, AnalyzeOptions& args);
/// --checkpoint, --checkpoint-every and --resume. @param takes a name for where it is saved: "FILE"
void declare_checkpoint(Options& options, std::optional<CheckpointOptions>& checkpoint, const char* takes);

}  // namespace coordreq

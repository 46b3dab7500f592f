#pragma once

#include <optional>
#include <string>

#include "analysis/checkpoint_options.hpp"
#include "app/progress_options.hpp"

namespace coordreq {

/// Options for work that takes long, as they stand on the command line.
struct LongRunArguments {
  std::optional<std::string> progress, progress_every;
  std::optional<std::string> checkpoint, checkpoint_every;
  bool resume = false;
};

/// @throws UsageError, as below
[[nodiscard]] ProgressOptions progress_options(const LongRunArguments& arguments);
/// None without --checkpoint.
[[nodiscard]] std::optional<CheckpointOptions> checkpoint_options(const LongRunArguments& arguments);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <optional>

#include "app/options.hpp"

namespace coordreq {

enum class ProgressMode : std::uint8_t {
  automatic,  ///< the bar, a line a minute where there is no terminal; but for --quiet
  bar,        ///< on a terminal
  log,
  none,
};

/// --progress and --progress-every.
struct ProgressOptions {
  ProgressMode mode = ProgressMode::automatic;
  std::optional<double> every_seconds = {};  ///< between two lines; nothing: 10 of a log, else 60
};

void declare_progress(Options& options, ProgressOptions& progress);

}  // namespace coordreq

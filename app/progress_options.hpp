#pragma once

#include <cstdint>

#include "app/options.hpp"

namespace coordreq {

enum class ProgressMode : std::uint8_t {
  automatic,  ///< the bar, but for --quiet
  bar,        ///< on a terminal; nothing elsewhere
  log,
  none,
};

/// --progress and --progress-every.
struct ProgressOptions {
  ProgressMode mode = ProgressMode::automatic;
  double every_seconds = 10;  ///< between two lines of a log
};

void declare_progress(Options& options, ProgressOptions& progress);

}  // namespace coordreq

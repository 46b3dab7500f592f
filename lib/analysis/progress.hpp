#pragma once

#include <cstdint>
#include <string>

namespace coordreq {

/// The current work. Either a fixed point that sweeps the grid again and again (`sweep` is not 0), or
/// a loop of known length (`all` is not 0), or work of which no more is known.
struct Progress {
  /// "controller" (if there is a file with one), "regions" (if there are requirements), "abstraction", "safe
  /// set", "invariance", "layers PARTITION", "network", "convention", "coalitions", "requirements" (where
  /// requested), "writing"
  std::string stage;
  std::string substage;         ///< of the stage, as "projections" before the layers; empty: all of it
  std::int64_t sweep = 0;       ///< number of the current sweep
  std::int64_t visited = 0;     ///< rows that it has computed so far
  std::int64_t layer = -1;      ///< the last one known to be final (WaveStep::layer); -1: none
  std::int64_t cells_left = 0;  ///< that this sweep has still to come to, of those that can still be lost
  std::int64_t cells = 0;       ///< all of those
  std::int64_t done = 0;        ///< of this pass
  std::int64_t all = 0;
  bool has_temporary = false;  ///< there may be a temporary file, which must not be left behind
  bool is_written = false;     ///< the results file is complete
};

}  // namespace coordreq

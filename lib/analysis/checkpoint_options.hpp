#pragma once

#include <string>
#include <vector>

namespace coordreq {

struct CheckpointOptions {
  std::string file;
  double every_seconds = 60;  ///< 0: at every step
  bool resume = false;        ///< go on from the file if there is one
};

/// The files that are written: the checkpoint, and the one that is given its name when it is complete.
[[nodiscard]] std::vector<std::string> files_of(const CheckpointOptions& options);

}  // namespace coordreq

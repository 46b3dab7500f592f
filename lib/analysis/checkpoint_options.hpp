#pragma once

#include <string>

namespace coordreq {

struct CheckpointOptions {
  std::string file;
  double every_seconds = 60;  ///< 0: at every step
  bool resume = false;        ///< go on from the file if there is one
};

}  // namespace coordreq

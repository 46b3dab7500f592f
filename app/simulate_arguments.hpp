#pragma once

#include <optional>
#include <string>

namespace coordreq {

/// The options of `simulate` as they were typed; those that were not are missing.
struct SimulateArguments {
  std::optional<std::string> from, start, steps, runs, seed, policy, disturbance, partition;
};

}  // namespace coordreq

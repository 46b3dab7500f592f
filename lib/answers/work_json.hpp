#pragma once

#include <nlohmann/json.hpp>

#include "base/json.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// The work of a fixed point, as in the summary's `work`.
[[nodiscard]] inline Json work_json(const WaveCounts& counts) {
  return {{"sweeps", counts.sweeps},
          {"rows_visited", counts.rows_visited},
          {"rows_skipped", counts.rows_skipped}};
}

}  // namespace coordreq

#pragma once

#include "engine/engine_sizes.hpp"

// What an analysis will hold in memory, told before any of it is there.
namespace coordreq {

/// Bytes that one answer needs.
struct MemoryNeed {
  double kept = 0;     ///< from its stages to the end
  double work = 0;     ///< more, at the most, while its stages are under way
  double written = 0;  ///< more, while the results file is written
  double array = 0;    ///< the longest dataset that it has there
};

/// Of the ground, and of writing what is of no answer.
[[nodiscard]] MemoryNeed ground_memory(const EngineSizes& sizes, int threads);

}  // namespace coordreq

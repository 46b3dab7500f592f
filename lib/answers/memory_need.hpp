#pragma once

#include "engine/engine_sizes.hpp"

// Estimates of the memory of an analysis, before it begins.
namespace coordreq {

/// Bytes that one answer needs.
struct MemoryNeed {
  double kept = 0;     ///< from its stages to the end
  double work = 0;     ///< the most in addition while its stages are under way
  double written = 0;  ///< in addition while the results file is written
  double array = 0;    ///< its longest dataset in the file
};

/// The need of the context, and of writing fields that belong to no answer.
[[nodiscard]] MemoryNeed context_memory(const EngineSizes& sizes, int threads);

}  // namespace coordreq

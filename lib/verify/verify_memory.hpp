#pragma once

#include "base/process_memory.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Memory of verifying a results file, in bytes.
struct VerifyMemory {
  double claims = 0;  ///< what the file says of all cells, with a copy of an array while it is read
  MemoryDemand work;  ///< posts of all cells, what is kept of each, and of a thread what it knows of one cell
};
[[nodiscard]] VerifyMemory verify_memory(const ResultsReader& results);

}  // namespace coordreq

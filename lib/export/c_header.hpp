#pragma once

#include <cstddef>

#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "export/text_sink.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// A C99 header, complete in itself, that holds the trigger table of one partition and the admissible actions
/// of its classes: functions from a measured state to its cell and from a cell to its countdown and actions.
///
/// Cells with the same countdown and actions that follow one another are one run; a lookup is a binary search
/// among the runs. Sets of actions are stored once each, as bits. Cells are found by comparing with the exact
/// faces, so that no rounding puts a state into another cell than query does.
/// @pre partition < results.partitions().size()
/// @throws LimitError beyond 2^31 - 1 cells; ResultsError if the actions cannot be computed
void export_c_header(const ResultsReader& results, std::size_t partition, ThreadTeam& team,
                     const TextSink& sink);
/// Memory of export_c_header().
[[nodiscard]] MemoryDemand c_header_demand(const ResultsReader& results);

}  // namespace coordreq

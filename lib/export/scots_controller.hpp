#pragma once

#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "export/text_sink.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The controller C as a static controller of SCOTS v0.2: the grids of states and joint inputs, and for each
/// cell of K its number and those of its admissible joint inputs. Numbers count with dimension 0 fastest.
/// @throws ResultsError if SCOTS cannot have the grids: points that are no multiples of the step, or listed
///   input values that are not evenly spaced and ascending
void export_scots(const ResultsReader& results, ThreadTeam& team, const TextSink& sink);
/// What that takes.
[[nodiscard]] MemoryDemand scots_demand(const ResultsReader& results);

}  // namespace coordreq

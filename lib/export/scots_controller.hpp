#pragma once

#include <cstdint>

#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "export/text_sink.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Which controller an export is of.
enum class ControllerKind : std::uint8_t {
  safety,    ///< C: that of K
  progress,  ///< P: that of the goal, in the cells from which it can be forced
};

/// The controller as a static controller of SCOTS v0.2: the grids of states and joint inputs, and for each
/// cell that has any its number and those of its joint inputs. Numbers count with dimension 0 fastest.
/// @throws ResultsError if SCOTS cannot have the grids: points that are no multiples of the step, or listed
///   input values that are not evenly spaced and ascending
/// @pre for `progress` the spec has a goal
void export_scots(const ResultsReader& results, ControllerKind kind, ThreadTeam& team, const TextSink& sink);
/// Memory of export_scots().
[[nodiscard]] MemoryDemand scots_demand(const ResultsReader& results);

}  // namespace coordreq

#pragma once

#include <cstddef>
#include <string>

#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "cell/simulation.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The number of the partition with this name, given or canonical; of the only one if `name` is empty.
/// @throws UsageError
[[nodiscard]] std::size_t find_partition(const ProblemSpec& spec, const std::string& name);

/// Memory of simulate_runs(), with all runs kept.
[[nodiscard]] MemoryDemand simulation_demand(const ResultsReader& results, const SimulationOptions& options);
/// Self-triggered closed loops on the system of a results file, from its K, its delays and its abstraction,
/// which is built again unless it is stored. Writes them to `options.output`, also runs that contradict the
/// analysis.
/// @throws UsageError naming the option whose value does not fit the results; SpecError if the spec holds
///   what this version cannot do; ResultsError, IoError
[[nodiscard]] Simulation simulate(const ResultsReader& results, const SimulationOptions& options,
                                  ThreadTeam& team);

}  // namespace coordreq

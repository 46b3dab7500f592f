#pragma once

#include <string>

#include "base/thread_team.hpp"
#include "cell/simulation.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Writes simulated runs as an HDF5 file that opens as netCDF-4, by the rules of write_results(): whole or
/// not at all, the same bytes whatever the number of threads.
///
/// Attributes of the file: `filetype` ("coordreq-runs"), `version`, and what the runs depend on. Dimensions
/// `run`, `time`, `state_name`, `input_name`, `disturbance_name`, all with coordinates. R runs of N steps
/// have N + 1 samples each; what a run that ended early does not have is filled.
/// @throws IoError as write_results() does
void write_runs(const std::string& path, const ResultsReader& results, const SimulationOptions& options,
                const Simulation& simulation, ThreadTeam& team);

}  // namespace coordreq

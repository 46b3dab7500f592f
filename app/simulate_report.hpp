#pragma once

#include "app/options.hpp"
#include "cell/simulate.hpp"

namespace coordreq {

/// Prints what `simulate` has found.
void print_simulation(const CommonOptions& asked, const Simulation& simulation, const ResultsReader& results,
                      const SimulationOptions& options);

}  // namespace coordreq

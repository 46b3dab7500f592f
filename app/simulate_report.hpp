#pragma once

#include <string>

#include "cell/simulate.hpp"

namespace coordreq {

/// What `simulate` prints for people.
[[nodiscard]] std::string simulation_text(const Simulation& simulation, const ResultsReader& results,
                                          const SimulationOptions& options);

/// What `simulate --json` prints: one document, keys in a fixed order, ending in a newline.
[[nodiscard]] std::string simulation_json(const Simulation& simulation, const ResultsReader& results,
                                          const SimulationOptions& options);

}  // namespace coordreq

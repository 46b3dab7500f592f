#pragma once

#include <string>

#include "app/json_text.hpp"
#include "cell/simulate.hpp"

namespace coordreq {

/// What `simulate` has found.
[[nodiscard]] Json simulation_json(const Simulation& simulation, const ResultsReader& results,
                                   const SimulationOptions& options);
/// The same in words. @param spec of the results
[[nodiscard]] std::string simulation_text(const Json& simulation, const ProblemSpec& spec);

}  // namespace coordreq

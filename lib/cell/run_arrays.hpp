#pragma once

#include "cell/simulate.hpp"
#include "results/run_content.hpp"

namespace coordreq {

/// The runs as a file holds them. REQUIRES: `inputs` and `simulation` outlive the result.
[[nodiscard]] RunContent run_content(const ResultsReader& results, const InputSpace& inputs,
                                     const SimulationOptions& options, const Simulation& simulation);

}  // namespace coordreq

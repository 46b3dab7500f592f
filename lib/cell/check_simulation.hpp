#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cell/simulation.hpp"
#include "results/results_reader.hpp"

// Refuses simulations that do not fit the results file.
namespace coordreq {

/// @throws UsageError naming an option that the spec, or another option, does not go with
void check_options(const ProblemSpec& spec, const SimulationOptions& options);

/// The state of `--from`, in its period. @throws UsageError
[[nodiscard]] std::vector<Rational> start_state(const ResultsReader& results, const std::string& text);

/// @param delays of all cells: those of the policy that runs begin with; negative where no run can start
/// @param kind that is requested, or null
/// @throws UsageError unless a run can start from the state
void check_start(const ResultsReader& results, const std::vector<Rational>& state,
                 std::span<const std::int32_t> delays, const CountdownKind* kind);

}  // namespace coordreq

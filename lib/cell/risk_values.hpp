#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "results/results_reader.hpp"

namespace coordreq {

/// [mode][path][cell] what safest_policy() asks of cells, from the risks of a results file. Nothing unless
/// connected agents of the spec are to be safest.
using RiskValues = std::vector<std::map<std::string, std::vector<std::int32_t>>>;
[[nodiscard]] RiskValues read_risk_values(const ResultsReader& results);

/// An upper bound of the probability that a run of so many steps from a cell, where the network is at the
/// first step as the spec says, leaves K: the risk, and the rate for each step beyond the horizon; of agents
/// without a clock, who are to be safest, for each step.
[[nodiscard]] double risk_of_runs(const ResultsReader& results, std::int64_t cell, std::int64_t steps);

/// Memory of the values of a cell, in bytes.
[[nodiscard]] double bytes_of_risk_values(const ProblemSpec& spec);

}  // namespace coordreq

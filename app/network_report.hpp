#pragma once

#include <string>
#include <vector>

#include "analysis/analyze.hpp"
#include "app/json_text.hpp"
#include "results/read_results.hpp"
#include "spec/problem_spec.hpp"

// What is said of the network, for people and as JSON.
namespace coordreq {

/// Which steps are lost: "at most 2 of any 5 steps are lost".
[[nodiscard]] std::string network_meaning(const NetworkSpec& network);

/// A section of the summary of `analyze`. @param invariant |K|
[[nodiscard]] std::string network_text(const NetworkSummary& summary, const NetworkSpec& network,
                                       std::int64_t invariant);
[[nodiscard]] Json network_json(const NetworkSummary& summary);

/// A section of `info`.
[[nodiscard]] std::string modes_text(const std::vector<ResultInfo::Mode>& modes);

/// A section of `query`. @param safe by mode
[[nodiscard]] std::string safe_modes_text(const NetworkSpec& network, const std::vector<bool>& safe);
[[nodiscard]] std::vector<std::string> safe_mode_names(const NetworkSpec& network,
                                                       const std::vector<bool>& safe);

}  // namespace coordreq

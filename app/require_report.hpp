#pragma once

#include <string>

#include "base/json.hpp"
#include "export/tolerance_frontier.hpp"
#include "results/results_reader.hpp"

// The answer of `require`.
namespace coordreq {

/// Its document: `corners` has for each a list of values, one a state of `over`: the face of its cell that is
/// the worst still tolerated, of a discrete state its value.
[[nodiscard]] Json require_json(const ResultsReader& results, const ToleranceQuestion& question,
                                const std::vector<FrontierCorner>& corners);
[[nodiscard]] std::string require_text(const Json& found);
/// A line for each corner, after one that names the states.
[[nodiscard]] std::string require_csv(const Json& found);

}  // namespace coordreq

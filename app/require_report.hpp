#pragma once

#include <string>

#include "base/json.hpp"
#include "export/tolerance_frontier.hpp"
#include "results/results_reader.hpp"

// The answer of `require`.
namespace coordreq {

/// Its document: `corners` has for each a list of values, one a state of `over`: the face of its cell that is
/// the worst still tolerated, of a discrete state its value. Of one state `intervals` has all that is
/// tolerated: lists of two values.
[[nodiscard]] Json require_json(const ResultsReader& results, const ToleranceQuestion& question,
                                const Tolerance& tolerance);
/// @param is_one_sided it was asked from which value on, or up to which, rather than for intervals
[[nodiscard]] std::string require_text(const Json& found, bool is_one_sided);
/// A line for each corner, or for each interval, after one that names the columns.
[[nodiscard]] std::string require_csv(const Json& found, bool is_one_sided);

}  // namespace coordreq

#pragma once

#include <string>

#include "app/json_text.hpp"
#include "results/compare_results.hpp"

namespace coordreq {

/// What `compare` has found. What fields are compared by stands under their names, but for the delay, which
/// is under `partitions`.
[[nodiscard]] Json comparison_json(const ResultsComparison& comparison, const ResultsReader& before,
                                   const ResultsReader& after, const CompareOptions& options);
/// The same in words.
[[nodiscard]] std::string comparison_text(const Json& comparison, const ResultsReader& before,
                                          const ResultsReader& after);

}  // namespace coordreq

#pragma once

#include <string>

#include "results/compare_results.hpp"

namespace coordreq {

/// What `compare` prints for people.
[[nodiscard]] std::string comparison_text(const ResultsComparison& comparison, const ResultsReader& before,
                                          const ResultsReader& after, const CompareOptions& options);

/// What `compare --json` prints: one document, keys in a fixed order, ending in a newline.
[[nodiscard]] std::string comparison_json(const ResultsComparison& comparison, const ResultsReader& before,
                                          const ResultsReader& after, const CompareOptions& options);

}  // namespace coordreq

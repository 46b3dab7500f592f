#pragma once

#include <string>

#include "base/json.hpp"
#include "cell/explain_delay.hpp"
#include "cell/state_query.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The findings of `explain` about a state in a cell, as a document. @param partition its number
[[nodiscard]] Json explanation_json(const DelayExplanation& found, const std::vector<Rational>& state,
                                    std::int64_t cell, std::size_t partition, const ResultsReader& results);
/// The document in words; no other source.
[[nodiscard]] std::string explanation_text(const Json& explanation, const ProblemSpec& spec);

}  // namespace coordreq

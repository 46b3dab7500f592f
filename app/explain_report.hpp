#pragma once

#include <string>

#include "app/json_text.hpp"
#include "cell/explain_delay.hpp"
#include "cell/state_query.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// What `explain` has found of a state in a cell, as a document. @param partition its number
[[nodiscard]] Json explanation_json(const DelayExplanation& found, const std::vector<Rational>& state,
                                    std::int64_t cell, std::size_t partition, const ResultsReader& results);
/// The same in words, made of nothing but it.
[[nodiscard]] std::string explanation_text(const Json& explanation, const ProblemSpec& spec);

}  // namespace coordreq

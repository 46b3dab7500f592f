#pragma once

#include <string>

#include "base/json.hpp"
#include "cell/least_steps.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The least steps of many pairs, as a document and in words.
[[nodiscard]] Json least_json(const LeastSteps& found, const Field& field, std::size_t partition,
                              std::optional<std::int32_t> at_least, const ResultsReader& results);
[[nodiscard]] std::string least_text(const Json& found, const Field& field);

}  // namespace coordreq

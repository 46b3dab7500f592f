#pragma once

#include <string>
#include <vector>

#include "app/json_text.hpp"
#include "cell/state_query.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// What `query` has found.
[[nodiscard]] Json answer_json(const StateAnswer& answer, const ResultsReader& results);
/// The same in words. @param state that was asked for
[[nodiscard]] std::string answer_text(const Json& answer, const std::vector<Rational>& state,
                                      const ResultsReader& results);

/// The line of column names, and a line with an answer.
[[nodiscard]] std::string answer_csv_header(const ResultsReader& results);
[[nodiscard]] std::string answer_csv_line(const StateAnswer& answer, const ResultsReader& results);

}  // namespace coordreq

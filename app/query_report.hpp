#pragma once

#include <string>

#include "cell/state_query.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// What `query` prints for people.
[[nodiscard]] std::string answer_text(const StateAnswer& answer, const ResultsReader& results);

/// What `query --json` prints: one document, indented, ending in a newline.
[[nodiscard]] std::string answer_json(const StateAnswer& answer, const ResultsReader& results);
/// The same on one line, for JSON lines.
[[nodiscard]] std::string answer_json_line(const StateAnswer& answer, const ResultsReader& results);

/// The line of column names, and a line with an answer.
[[nodiscard]] std::string answer_csv_header(const ResultsReader& results);
[[nodiscard]] std::string answer_csv_line(const StateAnswer& answer, const ResultsReader& results);

}  // namespace coordreq

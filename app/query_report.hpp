#pragma once

#include <string>
#include <vector>

#include "app/json_text.hpp"
#include "app/options.hpp"
#include "cell/state_query.hpp"
#include "cell/state_reader.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Prints what `query` has found of a state.
void print_state(const CommonOptions& asked, const StateAnswer& answer, const ResultsReader& results);

/// The same as a document, on one line, in words. @param state that was asked for
[[nodiscard]] Json answer_json(const StateAnswer& answer, const ResultsReader& results);
/// @param extra what stood beside the state, under the key `extra`; null: is not told
[[nodiscard]] std::string answer_json_line(const StateAnswer& answer, const ResultsReader& results,
                                           const std::vector<StateReader::Extra>* extra);
[[nodiscard]] std::string answer_text(const Json& answer, const std::vector<Rational>& state,
                                      const ResultsReader& results);

/// The line of column names, and a line with an answer; what stood beside the state comes last.
[[nodiscard]] std::string answer_csv_header(const ResultsReader& results,
                                            const std::vector<std::string>& extra);
[[nodiscard]] std::string answer_csv_line(const StateAnswer& answer, const ResultsReader& results,
                                          const std::vector<StateReader::Extra>& extra);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/text.hpp"
#include "base/json.hpp"
#include "results/results_reader.hpp"

// Elements of the texts of all commands: each text is rendered from the document that --json prints.
// Elements of answers in CSV.
namespace coordreq {

[[nodiscard]] std::int64_t number_of(const Json& json);
/// The text of a JSON string as it is, and on one line.
[[nodiscard]] std::string text_of(const Json& json);
[[nodiscard]] std::string line_of(const Json& json);
/// "1,234", "1,234 cells".
[[nodiscard]] std::string grouped(const Json& count);
[[nodiscard]] std::string cells(const Json& count);
/// "28 steps (0.28 s)". @param document with `period` and `period_unit`
[[nodiscard]] std::string duration(const Json& steps, const Json& document);
/// "x = 0.1, v = -2", of an object of numbers.
[[nodiscard]] std::string values_text(const Json& values);
/// Three digits, rounded up: no probability looks less than it is.
[[nodiscard]] std::string probability_text(const Json& probability);
/// "saturate", "unsafe below, safe above".
[[nodiscard]] std::string sides_text(const Json& outside);

/// "approach delay" of "approach_delay".
[[nodiscard]] std::string label_of(std::string key);

struct Column {
  std::string heading;
  Table::Align align;
  std::function<std::string(const Json& row)> text;
};
/// A line for each of a list, below the headings.
[[nodiscard]] std::string table_text(const Json& rows, const std::vector<Column>& columns);

/// Names and what is said of each: two columns to the left.
using Facts = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] std::string facts_text(const Facts& facts);

/// A section for each member that a text does not render itself: numbers, texts and flags as they are.
/// @param known members that it renders
[[nodiscard]] std::string others_text(const Json& document, const std::vector<std::string>& known);

/// A number of steps, "inf" without end.
[[nodiscard]] std::string csv_steps(std::int32_t steps);
/// A column that is no state; states may have its name, and then it is "answer:NAME".
[[nodiscard]] std::string answer_column(const std::string& name, const ResultsReader& results);
/// A field as it stands in CSV (RFC 4180).
[[nodiscard]] std::string csv_field(const std::string& text);

}  // namespace coordreq

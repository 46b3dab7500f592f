#pragma once

#include <cstdint>
#include <string>

#include "results/results_reader.hpp"

// The pieces of answers in CSV.
namespace coordreq {

/// A number of steps, "inf" without end.
[[nodiscard]] std::string csv_steps(std::int32_t steps);
/// A column that is no state; states may have its name, and then it is "answer:NAME".
[[nodiscard]] std::string answer_column(const std::string& name, const ResultsReader& results);
/// A field as it stands in CSV (RFC 4180).
[[nodiscard]] std::string csv_field(const std::string& text);

}  // namespace coordreq

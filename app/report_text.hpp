#pragma once

#include <cstdint>
#include <string>

#include "export/report_data.hpp"
#include "results/results_reader.hpp"

// The sections of the page of `report`, as HTML for people who do not code. A "state" there is a cell.
namespace coordreq {

/// What was asked, in short: description, agents, what counts as safe.
[[nodiscard]] std::string report_task(const ResultsReader& results);

/// For each partition the answer in a sentence. @param data of the page: the best cells
[[nodiscard]] std::string report_answer(const ResultsReader& results, const ReportData& data);

/// What was asked, in full: agents, states, the spec.
[[nodiscard]] std::string report_details(const ResultsReader& results);

/// Where the results come from.
[[nodiscard]] std::string report_footer(const ResultsReader& results);

/// "3.3 %" of what; never 0 or 100 unless it is none or all.
[[nodiscard]] std::string share_text(std::uint64_t part, std::uint64_t whole);

/// User text on one line as HTML.
[[nodiscard]] std::string html_line(const std::string& text);

}  // namespace coordreq

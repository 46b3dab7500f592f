#pragma once

#include <cstdint>
#include <string>

#include "export/report_data.hpp"
#include "results/results_reader.hpp"

// The sections of the page of `report`, as HTML for people who do not code. A "state" there is a cell.
namespace coordreq {

/// The description if it is short, else the name.
[[nodiscard]] std::string report_title(const ProblemSpec& spec);

/// The problem in short: description, agents, what counts as safe.
[[nodiscard]] std::string report_task(const ResultsReader& results);

/// For each partition the answer in a sentence. @param data of the page: the best cells
[[nodiscard]] std::string report_answer(const ResultsReader& results, const ReportData& data);

/// The problem in full: agents, states, the spec.
[[nodiscard]] std::string report_details(const ResultsReader& results);

/// Where the results come from.
[[nodiscard]] std::string report_footer(const ResultsReader& results);

/// The meaning of names in regions of requirements, except those that report_task() explains.
[[nodiscard]] std::string report_names_of_regions(const ProblemSpec& spec);

/// Whether a requirement of the results fails.
[[nodiscard]] bool has_failed_requirement(const ResultsReader& results);

/// Each requirement with its verdict, and what goes wrong where one fails; empty if there are none.
[[nodiscard]] std::string report_requirements(const ResultsReader& results);

}  // namespace coordreq

#pragma once

#include <string>
#include <vector>

#include "app/render.hpp"
#include "base/json.hpp"
#include "results/results_reader.hpp"
#include "spec/spec_types.hpp"

// The texts of single answers. Members of JSON without a text here are printed as they are; all other texts
// know no answer by name.
namespace coordreq {

/// Facts about the sets, of the summary of `analyze` and of `info`; nothing where there are none.
using AddFacts = void (*)(const Json& document, Facts& facts);
[[nodiscard]] const std::vector<AddFacts>& analysis_facts();
[[nodiscard]] const std::vector<AddFacts>& info_facts();

/// Sections in their order; each is empty where there is nothing to say.
using AnalysisSection = std::string (*)(const Json& summary, const ProblemSpec& spec);
[[nodiscard]] const std::vector<AnalysisSection>& analysis_sections();
using InfoSection = std::string (*)(const Json& info);
[[nodiscard]] const std::vector<InfoSection>& info_sections();
/// A section of the page of `report`, as HTML for people who do not code.
using ReportSection = std::string (*)(const ResultsReader& results);
[[nodiscard]] const std::vector<ReportSection>& report_sections();

/// A column of the table of many runs that only some specs have.
struct RunFigure {
  const char* name;
  const char* widest;  ///< as wide as its texts will be
  bool (*is_of)(const ProblemSpec& spec);
  std::string (*text)(const Json& summary);  ///< of a run whose spec has it
};
using RunFigures = std::vector<RunFigure>;
[[nodiscard]] const RunFigures& run_figures();

/// Members of both documents that these texts describe.
[[nodiscard]] const std::vector<std::string>& known_members();

/// Modes of the network that a table shows, and a line with the number of those left out; empty if none.
constexpr std::size_t kMostModes = 12;
[[nodiscard]] std::string more_modes(std::size_t modes);

// The texts of each answer, one file each:
void add_goal_of_analysis(const Json& summary, Facts& facts);
void add_goal_of_file(const Json& info, Facts& facts);
[[nodiscard]] std::string report_goal(const ResultsReader& results);
/// Who must talk to whom: the partitions that cells are given and the pairs that are critical.
[[nodiscard]] std::string coalitions_of_analysis(const Json& summary, const ProblemSpec& spec);
[[nodiscard]] std::string coalitions_of_file(const Json& info);
[[nodiscard]] std::string report_coalitions(const ResultsReader& results);
/// The modes of the network and where they are safe.
[[nodiscard]] std::string network_of_analysis(const Json& summary, const ProblemSpec& spec);
[[nodiscard]] std::string network_of_file(const Json& info);
[[nodiscard]] std::string report_network(const ResultsReader& results);
/// How likely the agents are to leave the invariance set.
[[nodiscard]] std::string risk_of_analysis(const Json& summary, const ProblemSpec& spec);
[[nodiscard]] std::string risk_of_file(const Json& info);
[[nodiscard]] std::string report_risk(const ResultsReader& results);
/// In the mode in which the network begins: the mean over the invariance set, and the greatest.
[[nodiscard]] std::string mean_risk(const Json& summary);
[[nodiscard]] std::string worst_risk(const Json& summary);
[[nodiscard]] bool has_risk(const ProblemSpec& spec);
[[nodiscard]] std::string convention_of_analysis(const Json& summary, const ProblemSpec& spec);
[[nodiscard]] std::string requirements_of_file(const Json& info);

/// A row of a table of the page: "NAME, DETAIL, 1,234, 12 %".
[[nodiscard]] std::string count_row(const std::string& name, const std::string& detail, std::uint64_t count,
                                    std::uint64_t whole);

}  // namespace coordreq

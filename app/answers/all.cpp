#include "app/answers/all.hpp"

#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/text.hpp"

namespace coordreq {

const std::vector<AddFacts>& analysis_facts() {
  static const std::vector<AddFacts> all = {add_goal_of_analysis};
  return all;
}

const std::vector<AddFacts>& info_facts() {
  static const std::vector<AddFacts> all = {add_goal_of_file};
  return all;
}

const std::vector<AnalysisSection>& analysis_sections() {
  static const std::vector<AnalysisSection> all = {network_of_analysis, risk_of_analysis,
                                                   convention_of_analysis, coalitions_of_analysis};
  return all;
}

const std::vector<InfoSection>& info_sections() {
  static const std::vector<InfoSection> all = {coalitions_of_file, requirements_of_file, network_of_file,
                                               risk_of_file};
  return all;
}

const std::vector<ReportSection>& report_sections() {
  static const std::vector<ReportSection> all = {report_goal, report_requirements, report_coalitions,
                                                 report_network, report_risk};
  return all;
}

const RunFigures& run_figures() {
  static const RunFigures all = {{"mean risk", "1.23e-10", has_risk, mean_risk},
                                 {"worst risk", "1.23e-10", has_risk, worst_risk}};
  return all;
}

const std::vector<std::string>& known_members() {
  static const std::vector<std::string> all = {"goal",         "coalition", "network", "convention",
                                               "requirements", "modes",     "risk"};
  return all;
}

std::string count_row(const std::string& name, const std::string& detail, std::uint64_t count,
                      std::uint64_t whole) {
  const std::string share = whole == 0 ? "" : share_text(count, whole);
  return html_row({html_line(name), html_line(detail), grouped(count), share});
}

}  // namespace coordreq

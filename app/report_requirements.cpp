#include <fmt/format.h>

#include <algorithm>

#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/requirement_report.hpp"
#include "app/requirement_story.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

std::string capital(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

std::string verdict(const ResultRequirement& result) {
  if (result.holds)
    return fmt::format("<span class=\"good\">met</span> by all {}", states_text(result.cells));
  const char* const failed = "<span class=\"bad\">failed</span>";
  if (!result.path) return failed;
  return fmt::format("{} in {} of {}", failed, grouped(result.failing), states_text(result.cells));
}

std::string worst(const ResultRequirement& result, const RequirementSpec& asked, const ProblemSpec& spec) {
  if (result.path)
    return fmt::format("{}: {}", start_text(*result.path, spec), worst_text(result.least_delay, spec));
  if (result.reached_side) return capital(outside_text(result, spec));
  if (asked.invariant) return "";
  return result.least_delay == ResultsReader::kNever ? "Never needs contact"
                                                     : capital(worst_text(result.least_delay, spec));
}

std::string summary_table(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  std::string rows;
  for (std::size_t r = 0; r < results.requirements().size(); ++r) {
    const ResultRequirement& result = results.requirements()[r];
    const RequirementSpec& asked = spec.requirements[r];
    rows +=
        html_row({html_line(result.name), verdict(result), html_line(capital(requirement_claim(asked, spec))),
                  html_code(asked.where.text), html_line(worst(result, asked, spec))});
  }
  return html_table("", {"Requirement", "Verdict", "Asked", "Where", "Worst state"}, rows, "roomy");
}

/// Leads to a sample in the pictures; a script shows it.
std::string visit_button(std::size_t way, std::size_t sample, const std::string& label,
                         const std::string& name) {
  return fmt::format(
      "<button type=\"button\" class=\"visit\" data-way=\"{}\" data-sample=\"{}\"{} hidden>{}</button>", way,
      sample, name.empty() ? "" : " aria-label=\"" + name + "\"", label);
}

std::string steps_table(std::size_t way, const StoryTable& story) {
  std::vector<std::string> heads;
  for (const std::string& head : story.heads) heads.push_back(html_line(head));
  std::string rows;
  for (std::size_t s = 0; s < story.rows.size(); ++s) {
    std::vector<std::string> cells;
    for (const std::string& cell : story.rows[s]) cells.push_back(html_line(cell));
    cells.front() += " " + visit_button(way, s, "Show", fmt::format("Show step {} in the picture", s));
    rows += html_row(cells);
  }
  return "<details><summary>Step by step</summary>\n" + html_table("", heads, rows, "story") +
         "<p class=\"note\">An independent action is one that the agent may take on its own; evasive actions "
         "put off the end for as long as possible. Delay and collision time are in steps.</p></details>\n";
}

std::string failure(std::size_t& way, const ResultRequirement& result, const RequirementSpec& asked,
                    const ProblemSpec& spec) {
  std::string html = fmt::format("<h3>{}</h3>\n<p>{}.</p>\n", html_line(result.name),
                                 html_line(capital(failure_line(result, spec))));
  if (!result.path) return html;
  html += "<p>";
  for (const std::string& sentence : story_sentences(*result.path, asked, spec))
    html += html_line(sentence) + " ";
  html += "</p>\n<p>" + visit_button(way, 0, "Show in the picture", "") + "</p>\n";
  return html + steps_table(way++, story_table(*result.path, asked, spec));
}

}  // namespace

std::string report_requirements(const ResultsReader& results) {
  const auto& all = results.requirements();
  if (all.empty()) return "";
  const ProblemSpec& spec = results.spec();
  const auto failed = static_cast<std::uint64_t>(
      std::count_if(all.begin(), all.end(), [](const auto& result) { return !result.holds; }));
  std::string html =
      "<section aria-labelledby=\"requirements-title\">\n<h2 id=\"requirements-title\">What is "
      "required</h2>\n";
  html += failed == 0 ? "<p>Every requirement is met.</p>\n"
                      : fmt::format("<p>{} of {} requirement{} fail{}.</p>\n", grouped(failed),
                                    grouped(all.size()), all.size() == 1 ? "" : "s", failed == 1 ? "s" : "");
  html += summary_table(results);
  std::size_t way = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (!all[r].holds) html += failure(way, all[r], spec.requirements[r], spec);
  }
  return html + "</section>\n";
}

}  // namespace coordreq

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/requirements/answer.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "app/render.hpp"
#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/requirement_text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string requirement_verdict(const Json& entry) {
  const auto cells = entry["cells"].get<std::uint64_t>();
  if (entry["holds"]) return fmt::format("<span class=\"good\">met</span> by all {}", states_text(cells));
  const char* const failed = "<span class=\"bad\">failed</span>";
  if (entry["counterexample"]["state"].is_null()) return failed;
  return fmt::format("{} in {} of {}", failed, grouped(entry["failing"].get<std::uint64_t>()),
                     states_text(cells));
}

std::string worst(const Json& entry, const ProblemSpec& spec) {
  const std::string key = worst_key(entry);
  const Json& status = entry[key + "_status"];
  const auto text = [&] { return worst_text(entry["kind"], entry[key], status, spec); };
  if (!entry["holds"].get<bool>() && !entry["counterexample"]["state"].is_null())
    return fmt::format("{}: {}", values_text(entry["counterexample"]["state"]), text());
  if (!entry["reaches_outside"].is_null()) return capital(outside_text(entry, spec));
  if (entry["kind"] == "invariant") return "";
  return status == "unbounded" ? "Never needs contact" : capital(text());
}

std::string summary_table(const std::vector<Json>& all, const ProblemSpec& spec) {
  std::string rows;
  for (std::size_t r = 0; r < all.size(); ++r) {
    rows += html_row({html_line(all[r]["name"].get<std::string>()), requirement_verdict(all[r]),
                      html_line(capital(claim_text(all[r], spec))),
                      html_code(spec.requirements[r].where.text), html_line(worst(all[r], spec))});
  }
  return html_table("", {"Requirement", "Verdict", "Asked", "Where", "Worst state"}, rows, "roomy");
}

/// Leads to a sample in the pictures; a script shows it.
std::string visit_button(std::size_t path, std::size_t sample, const std::string& label,
                         const std::string& name) {
  return fmt::format(
      "<button type=\"button\" class=\"visit\" data-way=\"{}\" data-sample=\"{}\"{} hidden>{}</button>", path,
      sample, name.empty() ? "" : " aria-label=\"" + name + "\"", label);
}

std::string steps_table(std::size_t path, const CounterexampleTable& table) {
  std::vector<std::string> heads;
  for (const std::string& head : table.heads) heads.push_back(html_line(head));
  std::string rows;
  for (std::size_t s = 0; s < table.rows.size(); ++s) {
    std::vector<std::string> cells;
    for (const std::string& cell : table.rows[s]) cells.push_back(html_line(cell));
    cells.front() += " " + visit_button(path, s, "Show", fmt::format("Show step {} in the picture", s));
    rows += html_row(cells);
  }
  return "<details><summary>Step by step</summary>\n" + html_table("", heads, rows, "story") +
         "<p class=\"note\">An independent action is one that the agent may take without coordination; "
         "evasive actions "
         "delay the violation for as long as possible. Delay and collision time are in "
         "steps.</p></details>\n";
}

std::string failure(std::size_t& path, const Json& entry, const ProblemSpec& spec) {
  // How many fail and the worst state are in the table above.
  if (entry["counterexample"]["state"].is_null()) return "";
  std::string html = fmt::format("<h3>{}</h3>\n", html_line(entry["name"].get<std::string>()));
  if (!entry["reaches_outside"].is_null())
    html += "<p>" + html_line(capital(outside_text(entry, spec))) + ".</p>\n";
  if (!has_steps(entry)) return html + "<p>" + visit_button(path++, 0, "Show in the picture", "") + "</p>\n";
  html += "<p>";
  const Counterexample found = counterexample_of(entry);
  for (const std::string& sentence : counterexample_sentences(found, spec)) html += html_line(sentence) + " ";
  html += "</p>\n<p>" + visit_button(path, 0, "Show in the picture", "") + "</p>\n";
  return html + steps_table(path++, counterexample_table(found, spec));
}

}  // namespace

bool has_failed_requirement(const ResultsReader& results) {
  const std::vector<ResultRequirement> all = read_requirement_values(results.spec(), results);
  return std::any_of(all.begin(), all.end(), [](const ResultRequirement& each) { return !each.holds; });
}

std::string report_requirements(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  std::vector<Json> all;
  const std::vector<ResultRequirement> requirements = read_requirement_values(spec, results);
  for (std::size_t r = 0; r < requirements.size(); ++r)
    all.push_back(requirement_json(requirements[r], spec.requirements[r], spec));
  if (all.empty()) return "";
  const auto failed = static_cast<std::uint64_t>(
      std::count_if(all.begin(), all.end(), [](const Json& entry) { return !entry["holds"].get<bool>(); }));
  std::string html =
      "<section aria-labelledby=\"requirements-title\">\n<h2 id=\"requirements-title\">What is "
      "required</h2>\n";
  html += failed == 0 ? "<p>Every requirement is met.</p>\n"
                      : fmt::format("<p>{} of {} requirement{} fail{}.</p>\n", grouped(failed),
                                    grouped(all.size()), all.size() == 1 ? "" : "s", failed == 1 ? "s" : "");
  html += summary_table(all, spec) + report_names_of_regions(spec);
  std::size_t path = 0;
  for (const Json& entry : all) {
    if (!entry["holds"].get<bool>()) html += failure(path, entry, spec);
  }
  return html + "</section>\n";
}

}  // namespace coordreq

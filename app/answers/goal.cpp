#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/answers/all.hpp"
#include "app/report_html.hpp"
#include "app/requirement_text.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string task_end_text(const Json& goal) {
  if (!goal.contains("then")) return "";
  return goal["cells"] == 1 ? ", which ends the task" : ", which end the task";
}

}  // namespace

void add_goal_of_analysis(const Json& summary, Facts& facts) {
  if (!summary.contains("goal")) return;
  const Json& goal = summary["goal"];
  std::string text = cells(goal["cells"]);
  text += task_end_text(goal);
  text += goal["longest_arrival"].is_null()
              ? "; it cannot be forced from anywhere"
              : fmt::format("; forced from {}, within {}", cells(goal["winning"]),
                            duration(goal["longest_arrival"], summary));
  facts.emplace_back("goal", text);
}

void add_goal_of_file(const Json& info, Facts& facts) {
  if (!info.contains("goal")) return;
  const Json& goal = info["goal"];
  facts.emplace_back("goal", grouped(goal["cells"]) + task_end_text(goal));
  facts.emplace_back("goal can be forced", grouped(goal["winning"]));
  if (!goal["longest_arrival"].is_null())
    facts.emplace_back("longest time to reach it", duration(goal["longest_arrival"], info));
}

/// How soon the goal can be forced, and from how many states silence costs no time.
std::string report_goal(const ResultsReader& results) {
  if (!results.spec().goal || results.attributes().invariant_cells == 0) return "";
  const auto goal = static_cast<std::uint64_t>(results.attribute("/arrival", "goal_cells"));
  const auto winning = static_cast<std::uint64_t>(results.attribute("/arrival", "winning_cells"));
  const std::int64_t longest = results.attribute("/arrival", "longest_arrival");
  std::string text = fmt::format(
      "<section aria-labelledby=\"goal-title\">\n<h2 id=\"goal-title\">How soon is the goal "
      "reached?</h2>\n<p>The goal is <code>{}</code>: {} {}. ",
      html_line(results.spec().goal->text), states_text(goal),
      results.spec().ends_at_goal ? "in which the task is over" : "that can be kept safe");
  if (longest < 0) return text + "It cannot be forced from any of them.</p>\n</section>\n";
  text += fmt::format(
      "Agents that coordinate can force it from {} of the states that can be kept safe, within {}.</p>\n",
      share_text(winning, results.attributes().invariant_cells),
      html_line(steps_text(longest, results.spec())));
  const std::vector<std::int64_t> sizes = results.integers("/approach_layer_size");
  const std::size_t layers = sizes.size() / results.partitions().size();
  std::vector<std::string> rows;
  for (std::size_t p = 0; p < results.partitions().size(); ++p) {
    const auto one = static_cast<std::uint64_t>(layers > 1 ? sizes[p * layers + 1] : sizes[p * layers]);
    rows.push_back(
        html_row({html_line(results.partitions()[p].name), grouped(one), share_text(one, winning)}));
  }
  return text + "<p>States from which a step of silence is safe and costs no time:</p>\n" +
         html_long_table({"Partition", "States", "Share"}, rows) + "</section>\n";
}

}  // namespace coordreq

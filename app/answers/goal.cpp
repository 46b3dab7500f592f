#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/answers/all.hpp"
#include "app/report_html.hpp"
#include "app/requirement_text.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

bool has_then(const Json& goal, const char* then) {
  return goal.contains("then") && goal["then"] == then;
}

std::string task_end_text(const Json& goal) {
  if (has_then(goal, "stay")) return " to stay at";
  if (has_then(goal, "return")) return " to return to";
  if (!goal.contains("then")) return "";
  return goal["cells"] == 1 ? ", which ends the task" : ", which end the task";
}

}  // namespace

/// "at most 3 samples outside it", "the next visit within 3 steps", "within 3 steps".
std::string longest_text(const Json& goal, const Json& document) {
  const Json& longest = goal["longest_arrival"];
  if (has_then(goal, "stay"))
    return fmt::format("at most {} outside it", count_of(longest.get<std::int64_t>(), "sample"));
  return (has_then(goal, "return") ? "the next visit within " : "within ") + duration(longest, document);
}

/// "2 steps can be forced, 3 steps at most whatever is chosen".
std::string returns_text(const Json& goal, const Json& document) {
  return fmt::format("{} can be forced, {} at most whatever is chosen",
                     duration(goal["longest_return"], document), duration(goal["longest_gap"], document));
}

bool has_returns(const Json& goal) {
  return has_then(goal, "return") && !goal["longest_return"].is_null();
}

void add_goal_of_analysis(const Json& summary, Facts& facts) {
  if (!summary.contains("goal")) return;
  const Json& goal = summary["goal"];
  std::string text = cells(goal["cells"]);
  text += task_end_text(goal);
  text += goal["longest_arrival"].is_null()
              ? "; it cannot be forced from anywhere"
              : fmt::format("; forced from {}, {}", cells(goal["winning"]), longest_text(goal, summary));
  facts.emplace_back("goal", text);
  if (has_returns(goal)) facts.emplace_back("time between visits", returns_text(goal, summary));
}

void add_goal_of_file(const Json& info, Facts& facts) {
  if (!info.contains("goal")) return;
  const Json& goal = info["goal"];
  facts.emplace_back("goal", grouped(goal["cells"]) + task_end_text(goal));
  facts.emplace_back("goal can be forced", grouped(goal["winning"]));
  if (has_then(goal, "stay") && !goal["longest_arrival"].is_null()) {
    facts.emplace_back("most samples outside it", grouped(goal["longest_arrival"].get<std::int64_t>()));
  } else if (!goal["longest_arrival"].is_null()) {
    facts.emplace_back("longest time to reach it", duration(goal["longest_arrival"], info));
  }
  if (has_returns(goal)) facts.emplace_back("time between visits", returns_text(goal, info));
}

namespace {

std::string lasting_text(GoalThen then) {
  if (then == GoalThen::stay) return "; agents are to stay there";
  return then == GoalThen::come_back ? "; agents are to return there again and again" : "";
}

}  // namespace

/// How soon the goal can be forced, and from how many states silence costs no time.
std::string report_goal(const ResultsReader& results) {
  if (!results.spec().goal || results.attributes().invariant_cells == 0) return "";
  const auto goal = static_cast<std::uint64_t>(results.attribute("/arrival", "goal_cells"));
  const auto winning = static_cast<std::uint64_t>(results.attribute("/arrival", "winning_cells"));
  const std::int64_t longest = results.attribute("/arrival", "longest_arrival");
  std::string text = fmt::format(
      "<section aria-labelledby=\"goal-title\">\n<h2 id=\"goal-title\">How soon is the goal "
      "reached?</h2>\n<p>The goal is <code>{}</code>: {} {}{}. ",
      html_line(results.spec().goal->text), states_text(goal),
      results.spec().ends_at_goal() ? "in which the task is over" : "that can be kept safe",
      lasting_text(results.spec().goal_then));
  if (longest < 0) return text + "It cannot be forced from any of them.</p>\n</section>\n";
  const std::string most = results.spec().goal_then == GoalThen::stay
                               ? fmt::format("at most {} outside it", count_of(longest, "sample"))
                               : "within " + html_line(steps_text(longest, results.spec()));
  text += fmt::format(
      "Agents that coordinate can force it from {} of the states that can be kept safe, {}.</p>\n",
      share_text(winning, results.attributes().invariant_cells), most);
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

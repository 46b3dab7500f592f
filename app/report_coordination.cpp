#include <fmt/format.h>

#include "answers/coalition/coalition_cost.hpp"
#include "answers/coalition/fields.hpp"
#include "answers/network/fields.hpp"
#include "answers/network/network_meaning.hpp"
#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/requirement_text.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string count_row(const std::string& name, const std::string& detail, std::uint64_t count,
                      std::uint64_t whole) {
  const std::string share = whole == 0 ? "" : share_text(count, whole);
  return html_row({html_line(name), html_line(detail), grouped(count), share});
}

std::string choices(const ResultsReader& results) {
  const std::vector<std::uint64_t> given = results.counted(paths::kCoalition);
  const std::uint64_t kept = results.attributes().invariant_cells;
  if (given.empty()) return "";
  std::vector<std::string> rows;
  std::uint64_t total = 0;
  for (const CoalitionChoice& choice : order_of_preference(results.spec().coordination)) {
    const std::uint64_t count = given[choice.partition];
    total += count;
    if (count > 0) {
      rows.push_back(count_row(results.partitions()[choice.partition].name,
                               fmt::format("{:.6g}", nearest_double(choice.cost)), count, kept));
    }
  }
  if (total < kept) rows.push_back(count_row("none of those listed suffices", "", kept - total, kept));
  return html_long_table({"Cheapest partition", "Cost", "States", "Share"}, rows);
}

std::string pairs(const ResultsReader& results) {
  const std::vector<std::uint64_t> counts = results.counted(paths::kCriticalPair);
  const std::vector<std::string> names = pair_names(results.spec());
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0)
      rows.push_back(html_row({html_line(names[i]), grouped(counts[i]),
                               share_text(counts[i], results.attributes().invariant_cells)}));
  }
  if (rows.empty()) return "<p>No pair of agents is critical.</p>\n";
  return html_long_table({"Critical pair", "States", "Share"}, rows);
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
      "reached?</h2>\n<p>The goal is <code>{}</code>: {} that can be kept safe. ",
      html_line(results.spec().goal->text), states_text(goal));
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

std::string report_coalitions(const ResultsReader& results) {
  if (!results.has(paths::kCoalition) || results.attributes().invariant_cells == 0) return "";
  return fmt::format(
             "<section aria-labelledby=\"coalition-title\">\n<h2 id=\"coalition-title\">Who must talk to "
             "whom?</h2>\n<p>For {} without further contact between them, these groups of agents must be "
             "connected: <code>a+b|c</code> means that <em>a</em> and <em>b</em> keep agreeing, and "
             "<em>c</em> is alone. Each state has the cheapest partition that is enough.</p>\n",
             html_line(steps_text(*results.spec().coordination.horizon, results.spec()))) +
         choices(results) +
         "<p>A pair of agents is critical in a state where every cheapest network that is enough connects "
         "the "
         "two.</p>\n" +
         pairs(results) + "</section>\n";
}

std::string report_network(const ResultsReader& results) {
  if (!results.spec().network || results.attributes().invariant_cells == 0) return "";
  const NetworkSpec& network = *results.spec().network;
  const std::vector<std::uint64_t> safe = results.counted(paths::kNetworkSafe);
  const std::uint64_t kept = results.attributes().invariant_cells;
  std::vector<std::string> rows;
  for (std::size_t mode = 0; mode < network.modes.size(); ++mode) {
    rows.push_back(count_row(network.modes[mode].name + (mode == 0 ? " (at first)" : ""),
                             network.modes[mode].partition.name, safe[mode], kept));
  }
  return fmt::format(
             "<section aria-labelledby=\"network-title\">\n<h2 id=\"network-title\">On a network that "
             "fails</h2>\n<div class=\"answer\"><p class=\"headline\">Agents {}stay safe from "
             "<strong>{}</strong> of the states that can be kept safe, whatever the network does.</p>\n"
             "<p>The network: {}.</p></div>\n",
             network.resynthesise ? "that take care because messages may be lost " : "",
             share_text(safe.front(), kept), html_line(network_meaning(network))) +
         html_long_table({"Mode of the network", "Connected", "Safe states", "Share"}, rows) + "</section>\n";
}

}  // namespace coordreq

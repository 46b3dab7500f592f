#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "answers/coalition/answer.hpp"
#include "answers/coalition/coalition_cost.hpp"
#include "answers/paths.hpp"
#include "app/answers/all.hpp"
#include "app/report_html.hpp"
#include "app/requirement_text.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

std::string choices_table(const Json& coalition) {
  Table table({Align::left, Align::right, Align::right});
  table.add({"  partition", "cost", "needed by"});
  for (const Json& choice : coalition["partitions"]) {
    if (choice["cells"] == 0) continue;
    table.add({"  " + text_of(choice["name"]), fmt::format("{:.6g}", choice["cost"].get<double>()),
               cells(choice["cells"])});
  }
  if (coalition["no_partition_suffices"] > 0)
    table.add({"  none of those listed suffices", "", cells(coalition["no_partition_suffices"])});
  return table.text();
}

std::string pairs_table(const Json& coalition) {
  Table table({Table::Align::left, Table::Align::right});
  table.add({"  critical pair", "in"});
  bool any = false;
  for (const Json& pair : coalition["critical_pairs"]) {
    if (pair["cells"] == 0) continue;
    table.add({"  " + text_of(pair["name"]), cells(pair["cells"])});
    any = true;
  }
  return any ? table.text() : "  no pair is critical\n";
}

std::string report_choices(const ResultsReader& results) {
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

std::string report_pairs(const ResultsReader& results) {
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

std::string coalitions_of_analysis(const Json& summary, const ProblemSpec& /*spec*/) {
  const Json& coalition = summary["coalition"];
  if (coalition.is_null() || summary["invariant"] == 0) return "";
  return fmt::format("\ncoalitions for {} without further contact\n{}{}",
                     duration(coalition["horizon"], summary), choices_table(coalition),
                     pairs_table(coalition));
}

/// The number of cells that are given each partition, and of those in which each pair is critical, if there
/// are any.
std::string coalitions_of_file(const Json& info) {
  const Json& coalition = info["coalition"];
  if (coalition.is_null()) return "";
  Table table({Align::left, Align::right});
  const auto add = [&table](const std::string& name, const Json& count) {
    if (!count.is_null() && count > 0) table.add({name, cells(count)});
  };
  for (const Json& entry : coalition["partitions"]) add("  " + line_of(entry["name"]), entry["cells"]);
  add("  none suffices", coalition["no_partition_suffices"]);
  for (const Json& entry : coalition["critical_pairs"])
    add("  critical pair " + line_of(entry["name"]), entry["cells"]);
  return fmt::format("\ncoalitions for {}\n{}", duration(coalition["horizon"], info), table.text());
}

std::string report_coalitions(const ResultsReader& results) {
  if (!results.has(paths::kCoalition) || results.attributes().invariant_cells == 0) return "";
  return fmt::format(
             "<section aria-labelledby=\"coalition-title\">\n<h2 id=\"coalition-title\">Who must "
             "communicate with whom?</h2>\n<p>For {} without further contact between them, these groups of "
             "agents must be "
             "connected: <code>a+b|c</code> means that <em>a</em> and <em>b</em> coordinate, and "
             "<em>c</em> chooses alone. Each state has the cheapest sufficient partition.</p>\n",
             html_line(steps_text(*results.spec().coordination.horizon, results.spec()))) +
         report_choices(results) +
         "<p>A pair of agents is critical in a state if every cheapest sufficient partition connects the "
         "two.</p>\n" +
         report_pairs(results) + "</section>\n";
}

}  // namespace coordreq

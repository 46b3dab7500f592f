#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/network/network_meaning.hpp"
#include "answers/paths.hpp"
#include "app/answers/all.hpp"
#include "app/report_html.hpp"
#include "app/reports.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// What agents go by, after the word "agents"; empty for independent ones.
std::string manner_of(const NetworkSpec& network) {
  if (network.resynthesise) return " with robust re-synthesis";
  return network.acts_by_rule ? " under the communication-loss rule" : "";
}

}  // namespace

std::string more_modes(std::size_t modes) {
  return modes <= kMostModes ? "" : fmt::format("  ... and {} more modes\n", grouped(modes - kMostModes));
}

std::string network_of_analysis(const Json& summary, const ProblemSpec& spec) {
  if (!spec.network || !has_partitions_in_full(summary)) return "";
  const Json& entry = summary["network"];
  const std::string manner = manner_of(*spec.network);
  const Json& modes = entry["modes"];
  Table table({Table::Align::left, Table::Align::left, Table::Align::right});
  table.add({"  mode", "connected", "safe cells"});
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode) {
    table.add({"  " + text_of(modes[mode]["name"]), text_of(modes[mode]["partition"]),
               grouped(modes[mode]["cells"])});
  }
  return fmt::format(
      "\nnetwork {}: {}\n{}{}  Beginning in mode {}, {} stay safe from {} of {}; beginning in any mode, "
      "from {}.\n",
      text_of(entry["kind"]), network_meaning(*spec.network), table.text(), more_modes(modes.size()),
      text_of(entry["initial"]), manner.empty() ? "the agents" : "agents" + manner,
      grouped(modes.front()["cells"]), cells(summary["invariant"]), grouped(entry["cells_in_every_mode"]));
}

std::string network_of_file(const Json& info) {
  if (!info.contains("modes")) return "";
  const Json& modes = info["modes"];
  Table table({Table::Align::left, Table::Align::right});
  table.add({"mode of the network", "safe cells"});
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode)
    table.add({line_of(modes[mode]["name"]), grouped(modes[mode]["cells"])});
  return "\n" + table.text() + more_modes(modes.size());
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
             "<section aria-labelledby=\"network-title\">\n<h2 id=\"network-title\">On an unreliable "
             "network</h2>\n<div class=\"answer\"><p class=\"headline\">Agents{} stay safe from "
             "<strong>{}</strong> of the states that can be kept safe, whatever the network does.</p>\n"
             "<p>The network: {}.</p></div>\n",
             manner_of(network), share_text(safe.front(), kept), html_line(network_meaning(network))) +
         html_long_table({"Mode of the network", "Connected", "Safe states", "Share"}, rows) + "</section>\n";
}

}  // namespace coordreq

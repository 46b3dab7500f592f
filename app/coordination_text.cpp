#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/network/network_meaning.hpp"
#include "app/analysis_text.hpp"
#include "app/network_report.hpp"
#include "app/render.hpp"
#include "spec/coordination_spec.hpp"

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

}  // namespace

std::string coalition_text(const Json& summary) {
  const Json& coalition = summary["coalition"];
  if (coalition.is_null() || summary["invariant"] == 0) return "";
  return fmt::format("\ncoalitions for {} without further contact\n{}{}",
                     duration(coalition["horizon"], summary), choices_table(coalition),
                     pairs_table(coalition));
}

std::string network_text(const Json& summary, const NetworkSpec& network) {
  const Json& own = summary["network"];
  const Json& modes = own["modes"];
  Table table({Table::Align::left, Table::Align::left, Table::Align::right});
  table.add({"  mode", "connected", "safe cells"});
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode) {
    table.add({"  " + text_of(modes[mode]["name"]), text_of(modes[mode]["partition"]),
               grouped(modes[mode]["cells"])});
  }
  return fmt::format(
      "\nnetwork {}: {}\n{}{}  Beginning in mode {}, {} stay safe from {} of {}; whatever the mode is, from "
      "{}.\n",
      text_of(own["kind"]), network_meaning(network), table.text(), more_modes(modes.size()),
      text_of(own["initial"]), own["resynthesise"] ? "agents that take care" : "the agents",
      grouped(modes.front()["cells"]), cells(summary["invariant"]), grouped(own["cells_in_every_mode"]));
}

}  // namespace coordreq

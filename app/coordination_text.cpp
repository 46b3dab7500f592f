#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/analysis_text.hpp"
#include "app/network_report.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

std::string choices_table(const Json& coalition) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::right});
  table.add({"  partition", "cost", "needed by"});
  for (const Json& choice : coalition["partitions"]) {
    if (choice["cells"] == 0) continue;
    table.add({"  " + choice["name"].get<std::string>(), fmt::format("{:.6g}", choice["cost"].get<double>()),
               cells(choice["cells"].get<std::int64_t>())});
  }
  if (coalition["no_partition_suffices"] > 0) {
    table.add({"  none of those listed suffices", "",
               cells(coalition["no_partition_suffices"].get<std::int64_t>())});
  }
  return table.text();
}

std::string pairs_table(const Json& coalition) {
  Table table({Table::Align::left, Table::Align::right});
  table.add({"  critical pair", "in"});
  bool any = false;
  for (const Json& pair : coalition["critical_pairs"]) {
    if (pair["cells"] == 0) continue;
    table.add({"  " + pair["name"].get<std::string>(), cells(pair["cells"].get<std::int64_t>())});
    any = true;
  }
  return any ? table.text() : "  no pair is critical\n";
}

}  // namespace

std::string coalition_text(const Json& summary) {
  const Json& coalition = summary["coalition"];
  if (coalition.is_null() || summary["invariant"] == 0) return "";
  const std::string horizon =
      duration(coalition["horizon"].get<std::int64_t>(), summary["period"].get<double>(),
               summary["period_unit"].get<std::string>());
  return fmt::format("\ncoalitions for {} without further contact\n{}{}", horizon, choices_table(coalition),
                     pairs_table(coalition));
}

std::string network_text(const Json& summary, const NetworkSpec& network) {
  const Json& own = summary["network"];
  const Json& modes = own["modes"];
  const auto cells_of = [](const Json& mode) { return grouped(mode["cells"].get<std::int64_t>()); };
  Table table({Table::Align::left, Table::Align::left, Table::Align::right});
  table.add({"  mode", "connected", "safe cells"});
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode) {
    table.add({"  " + modes[mode]["name"].get<std::string>(), modes[mode]["partition"].get<std::string>(),
               cells_of(modes[mode])});
  }
  return fmt::format(
      "\nnetwork {}: {}\n{}{}  Beginning in mode {}, {} stay safe from {} of {}; whatever the mode is, from "
      "{}.\n",
      own["kind"].get<std::string>(), network_meaning(network), table.text(), more_modes(modes.size()),
      own["initial"].get<std::string>(),
      own["resynthesise"].get<bool>() ? "agents that take care" : "the agents", cells_of(modes.front()),
      cells(summary["invariant"].get<std::int64_t>()),
      grouped(own["cells_in_every_mode"].get<std::int64_t>()));
}

}  // namespace coordreq

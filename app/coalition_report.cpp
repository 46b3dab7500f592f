#include "app/coalition_report.hpp"

#include <fmt/format.h>

#include "app/text.hpp"

namespace coordreq {
namespace {

std::string choices_table(const CoalitionSummary& coalition) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::right});
  table.add({"  partition", "cost", "needed by"});
  for (const CoalitionSummary::Choice& choice : coalition.choices) {
    if (choice.cells > 0)
      table.add({"  " + choice.partition, fmt::format("{:.6g}", choice.cost), cells(choice.cells)});
  }
  if (coalition.without > 0) table.add({"  none of those listed suffices", "", cells(coalition.without)});
  return table.text();
}

std::string pairs_table(const CoalitionSummary& coalition) {
  Table table({Table::Align::left, Table::Align::right});
  table.add({"  critical pair", "in"});
  bool any = false;
  for (const auto& [pair, count] : coalition.critical_pairs) {
    if (count > 0) table.add({"  " + pair, cells(count)});
    any = any || count > 0;
  }
  return any ? table.text() : "  no pair is critical\n";
}

}  // namespace

std::string coalition_text(const AnalysisSummary& summary) {
  if (!summary.coalition || summary.invariant == 0) return "";
  const CoalitionSummary& coalition = *summary.coalition;
  return fmt::format("\ncoalitions for {} without further contact\n{}{}",
                     duration(coalition.horizon, summary.period, summary.period_unit),
                     choices_table(coalition), pairs_table(coalition));
}

Json coalition_json(const AnalysisSummary& summary) {
  if (!summary.coalition) return {};
  const CoalitionSummary& coalition = *summary.coalition;
  Json json;
  json["horizon"] = coalition.horizon;
  json["horizon_time"] = coalition.horizon_time;
  json["partitions"] = Json::array();
  for (const CoalitionSummary::Choice& choice : coalition.choices)
    json["partitions"].push_back(
        {{"name", choice.partition}, {"cost", choice.cost}, {"cells", choice.cells}});
  json["no_partition_suffices"] = coalition.without;
  json["critical_pairs"] = Json::array();
  for (const auto& [pair, count] : coalition.critical_pairs)
    json["critical_pairs"].push_back({{"name", pair}, {"cells", count}});
  return json;
}

}  // namespace coordreq

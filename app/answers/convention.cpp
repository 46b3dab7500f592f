#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "app/answers/all.hpp"
#include "app/reports.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

/// Where an agent keeps at most half of its actions.
std::string cells_of_half(const Json& entry) {
  const auto histogram = entry["histogram"].get<std::vector<std::int64_t>>();
  return cells(std::accumulate(histogram.begin(), histogram.begin() + 5, std::int64_t{0}));
}

}  // namespace

std::string convention_of_analysis(const Json& summary, const ProblemSpec& /*spec*/) {
  if (!summary.contains("convention") || !has_partitions_in_full(summary)) return "";
  return fmt::format(
      "\nconvention\n{}  Agents that keep to it never need to coordinate inside the invariance set.\n",
      table_text(
          summary["convention"],
          {{"  agent", Align::left, [](const Json& entry) { return "  " + text_of(entry["agent"]); }},
           {"keeps on average", Align::right,
            [](const Json& entry) { return fmt::format("{:.1f} %", 100 * entry["mean"].get<double>()); }},
           {"all in", Align::right, [](const Json& entry) { return cells(entry["full"]); }},
           {"at most half in", Align::right, cells_of_half}}));
}

}  // namespace coordreq

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/analysis_json.hpp"
#include "app/commands/all.hpp"
#include "app/json_text.hpp"
#include "app/network_report.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "results/read_results.hpp"

namespace coordreq {
namespace {

std::string head_table(const ResultInfo& info) {
  Table table({Table::Align::left, Table::Align::left});
  table.add({"name", printable(info.name)});
  table.add({"written by",
             fmt::format("coordreq {} ({})", printable(info.coordreq_version), printable(info.git_sha1))});
  table.add({"spec SHA-256", printable(info.spec_sha256)});
  if (!info.controller_sha256.empty()) table.add({"controller SHA-256", printable(info.controller_sha256)});
  table.add({"period", fmt::format("{:.6g} {}", info.period, printable(info.period_unit))});
  table.add({"connection delay", duration(info.connection_delay, info.period, info.period_unit)});
  table.add({"guarantee", guarantee_text(info.guarantee)});
  table.add({"cells", grouped(info.cells)});
  table.add({"safe set", grouped(info.safe_cells)});
  table.add({"invariance set", grouped(info.invariant_cells)});
  return table.text();
}

std::string axes_table(const ResultInfo& info) {
  using Align = Table::Align;
  Table table({Align::left, Align::left, Align::right, Align::right, Align::right, Align::left});
  table.add({"axis", "kind", "points", "first", "last", "unit"});
  const auto add = [&table](const std::vector<ResultInfo::Axis>& axes, const char* kind) {
    for (const ResultInfo::Axis& axis : axes) {
      table.add({printable(axis.name), kind, grouped(axis.points), fmt::format("{:.6g}", axis.first),
                 fmt::format("{:.6g}", axis.last), printable(axis.unit)});
    }
  };
  add(info.states, "state");
  add(info.inputs, "input");
  return table.text();
}

std::string partitions_table(const ResultInfo& info) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::left});
  table.add({"partition", "F", "layers"});
  for (const ResultInfo::Partition& partition : info.partitions) {
    const std::vector<std::int64_t> sizes(partition.layer_sizes.begin(), partition.layer_sizes.end());
    const std::int32_t index = partition.fixed_point_index;
    table.add(
        {printable(partition.name), index < 0 ? "not reached" : std::to_string(index), shortened(sizes)});
  }
  return table.text();
}

/// Cells of K for which no partition of the file is enough.
std::int64_t cells_without(const ResultInfo& info) {
  const std::vector<std::int64_t>& given = info.coalition->cells;
  return std::accumulate(given.begin(), given.end(), static_cast<std::int64_t>(info.invariant_cells),
                         std::minus<>());
}

/// How many cells are given which partition, and where pairs are critical, as far as there are any.
std::string coalition_text(const ResultInfo& info) {
  if (!info.coalition) return "";
  const ResultInfo::Coalition& coalition = *info.coalition;
  Table table({Table::Align::left, Table::Align::right});
  for (std::size_t p = 0; p < coalition.cells.size(); ++p) {
    if (coalition.cells[p] > 0)
      table.add({"  " + printable(info.partitions[p].name), cells(coalition.cells[p])});
  }
  if (!coalition.cells.empty() && cells_without(info) > 0)
    table.add({"  none suffices", cells(cells_without(info))});
  for (const auto& [pair, count] : coalition.critical_pairs) {
    if (count > 0) table.add({"  critical pair " + printable(pair), cells(count)});
  }
  return fmt::format("\ncoalitions for {}\n{}", duration(coalition.horizon, info.period, info.period_unit),
                     table.text());
}

std::string requirements_table(const ResultInfo& info) {
  using Align = Table::Align;
  Table table({Align::left, Align::left, Align::right, Align::right, Align::left, Align::right});
  table.add({"requirement", "verdict", "cells", "failing", "least delay", "counterexample"});
  for (const ResultRequirement& requirement : info.requirements) {
    const std::string delay = delay_word(requirement.least_delay);
    table.add({printable(requirement.name), requirement.holds ? "holds" : "FAILS", grouped(requirement.cells),
               grouped(requirement.failing),
               delay == "steps" ? duration(requirement.least_delay, info.period, info.period_unit) : delay,
               requirement.path ? duration(static_cast<std::int64_t>(requirement.path->steps()), info.period,
                                           info.period_unit)
               : requirement.holds ? "-"
                                   : "outside the domain"});
  }
  return info.requirements.empty() ? "" : "\n" + table.text();
}

std::string info_text(const ResultInfo& info) {
  std::string text = head_table(info) + "\n" + axes_table(info) + "\n" + partitions_table(info) +
                     coalition_text(info) + requirements_table(info);
  if (!info.modes.empty()) text += "\n" + modes_text(info.modes);
  text += "\ndatasets\n";
  for (const std::string& dataset : info.datasets) text += "  " + printable(dataset) + "\n";
  return text;
}

Json axes_json(const std::vector<ResultInfo::Axis>& axes) {
  Json json = Json::array();
  for (const ResultInfo::Axis& axis : axes) {
    json.push_back(Json{{"name", axis.name},
                        {"unit", axis.unit},
                        {"points", axis.points},
                        {"first", axis.first},
                        {"last", axis.last}});
  }
  return json;
}

Json partition_json(const ResultInfo::Partition& partition) {
  const bool truncated = partition.fixed_point_index < 0;
  Json json;
  json["name"] = partition.name;
  json["F"] = truncated ? Json() : Json(partition.fixed_point_index);
  json["layers"] = partition.layer_sizes;
  json["truncated"] = truncated;
  return json;
}

Json coalition_json(const ResultInfo& info) {
  if (!info.coalition) return {};
  const ResultInfo::Coalition& coalition = *info.coalition;
  Json json;
  json["horizon"] = coalition.horizon;
  json["partitions"] = Json::array();
  for (std::size_t p = 0; p < coalition.cells.size(); ++p)
    json["partitions"].push_back({{"name", info.partitions[p].name}, {"cells", coalition.cells[p]}});
  json["no_partition_suffices"] = coalition.cells.empty() ? Json() : Json(cells_without(info));
  json["critical_pairs"] = Json::array();
  for (const auto& [pair, count] : coalition.critical_pairs)
    json["critical_pairs"].push_back({{"name", pair}, {"cells", count}});
  return json;
}

Json requirement_json(const ResultRequirement& requirement) {
  Json json;
  json["name"] = requirement.name;
  json["holds"] = requirement.holds;
  json["cells"] = requirement.cells;
  json["failing"] = requirement.failing;
  json["least_delay"] = delay_json(requirement.least_delay);
  json["least_delay_status"] = delay_word(requirement.least_delay);
  json["counterexample_steps"] = requirement.path ? Json(requirement.path->steps()) : Json();
  return json;
}

std::string info_json(const ResultInfo& info) {
  Json json;
  json["file"] = info.path;
  json["name"] = info.name;
  json["coordreq_version"] = info.coordreq_version;
  json["git_sha1"] = info.git_sha1;
  json["spec_sha256"] = info.spec_sha256;
  if (!info.controller_sha256.empty()) json["controller_sha256"] = info.controller_sha256;
  json["guarantee"] = info.guarantee;
  json["period"] = info.period;
  json["period_unit"] = info.period_unit;
  json["connection_delay"] = info.connection_delay;
  json["states"] = axes_json(info.states);
  json["inputs"] = axes_json(info.inputs);
  json["cells"] = info.cells;
  json["safe"] = info.safe_cells;
  json["invariant"] = info.invariant_cells;
  json["partitions"] = Json::array();
  for (const ResultInfo::Partition& partition : info.partitions)
    json["partitions"].push_back(partition_json(partition));
  json["coalition"] = coalition_json(info);
  for (const ResultInfo::Mode& mode : info.modes)
    json["modes"].push_back(Json{{"name", mode.name}, {"cells", mode.safe_cells}});
  json["requirements"] = Json::array();
  for (const ResultRequirement& requirement : info.requirements)
    json["requirements"].push_back(requirement_json(requirement));
  json["datasets"] = info.datasets;
  return json_text(json);
}

struct InfoOptions : CommonOptions {
  std::string results;
};

ExitCode run(const InfoOptions& own) {
  const ResultInfo info = read_info(own.results, own.max_memory);
  if (own.json) {
    write_output(info_json(info));
  } else if (!own.quiet) {
    write_output(info_text(info));
  }
  return ExitCode::success;
}

}  // namespace

Run declare_info(Options& options) {
  const auto own = std::make_shared<InfoOptions>();
  declare_results(options, own->results);
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq

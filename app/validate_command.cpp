#include <fmt/format.h>

#include "analysis/analyze.hpp"
#include "answers/requirements/judge_requirements.hpp"
#include "app/commands.hpp"
#include "app/json_text.hpp"
#include "app/load_spec.hpp"
#include "app/memory_limit.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

std::string dependencies(const SpecReport::State& state) {
  std::vector<std::string> all = state.states;
  all.insert(all.end(), state.inputs.begin(), state.inputs.end());
  all.insert(all.end(), state.disturbances.begin(), state.disturbances.end());
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string states_table(const SpecReport& report) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::left, Align::left, Align::right, Align::right, Align::left});
  table.add({"state", "points", "unit", "table", "entries", "memory", "next value depends on"});
  for (const SpecReport::State& state : report.states) {
    table.add({state.name, grouped(state.points), printable(state.unit),
               state.sum     ? "sum"
               : state.shift ? "shift"
                             : "full",
               grouped(state.table_entries), byte_size(state.table_bytes), dependencies(state)});
  }
  return table.text();
}

std::string inputs_table(const SpecReport& report) {
  Table table({Table::Align::left, Table::Align::right, Table::Align::left});
  table.add({"input", "points", "unit"});
  for (const SpecReport::Input& input : report.inputs) {
    table.add({input.name, grouped(input.points), printable(input.unit)});
  }
  return table.text();
}

/// All of a few, else how many and the first and last of them.
std::string partitions_text(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 15;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{}: {}, {}, ... {}", grouped(std::uint64_t{names.size()}), names[0], names[1],
                     names.back());
}

std::string totals_table(const SpecReport& report) {
  Table table({Table::Align::left, Table::Align::left});
  table.add({"cells", grouped(report.cells)});
  table.add({"joint inputs", grouped(report.joint_inputs)});
  table.add({"partitions", partitions_text(report.partitions)});
  if (!report.modes.empty()) table.add({"modes of the network", grouped(report.modes.size())});
  table.add({"reachable sets", report.exact ? "exact interval hulls" : "outward rounded"});
  table.add({"guarantee", guarantee_text(report.guarantee)});
  table.add({"memory of analyze", "about " + byte_size(report.memory_bytes)});
  return table.text();
}

std::string report_text(const SpecReport& report) {
  return fmt::format("{}: the spec is valid\n\n{}\n{}\n{}", report.name, states_table(report),
                     inputs_table(report), totals_table(report));
}

Json state_json(const SpecReport::State& state) {
  Json json;
  json["name"] = state.name;
  json["unit"] = state.unit;
  json["points"] = state.points;
  json["depends_on"] =
      Json{{"states", state.states}, {"inputs", state.inputs}, {"disturbances", state.disturbances}};
  json["shift"] = state.shift;
  json["sum"] = state.sum;
  json["table_entries"] = state.table_entries;
  json["table_bytes"] = state.table_bytes;
  return json;
}

std::string report_json(const SpecReport& report) {
  Json json;
  json["name"] = report.name;
  json["cells"] = report.cells;
  json["joint_inputs"] = report.joint_inputs;
  json["states"] = Json::array();
  for (const SpecReport::State& state : report.states) json["states"].push_back(state_json(state));
  json["inputs"] = Json::array();
  for (const SpecReport::Input& input : report.inputs) {
    json["inputs"].push_back(Json{{"name", input.name}, {"unit", input.unit}, {"points", input.points}});
  }
  json["partitions"] = report.partitions;
  if (!report.modes.empty()) json["modes"] = report.modes;
  json["exact"] = report.exact;
  json["guarantee"] = report.guarantee;
  json["memory_bytes"] = report.memory_bytes;
  return json_text(json);
}

}  // namespace

ExitCode run_validate(const CommandLine& line) {
  const ProblemSpec spec = load_spec(line.path, line.settings);
  const SpecReport report = inspect(spec);
  // What cannot be analysed here need not be looked at closely.
  const std::optional<std::uint64_t> memory = line.max_memory ? line.max_memory : available_memory();
  if (!memory || report.memory_bytes <= *memory) {
    ThreadTeam team(line.threads);
    check_regions(spec, team);
  }
  if (line.json) {
    write_output(report_json(report));
  } else if (!line.quiet) {
    write_output(report_text(report));
  }
  return ExitCode::success;
}

}  // namespace coordreq

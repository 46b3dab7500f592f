#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/analyze.hpp"
#include "answers/requirements/judge_requirements.hpp"
#include "app/commands/all.hpp"
#include "app/json_text.hpp"
#include "app/load_spec.hpp"
#include "app/memory_limit.hpp"
#include "app/print_answer.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

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

Json report_json(const SpecReport& report) {
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
  return json;
}

std::string text_of(const Json& json) {
  return json.get<std::string>();
}

std::string count_of(const Json& json) {
  return grouped(json.get<std::uint64_t>());
}

std::string dependencies(const Json& state) {
  std::vector<std::string> all;
  for (const Json& kind : state["depends_on"]) {
    for (const Json& name : kind) all.push_back(text_of(name));
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

const char* table_kind(const Json& state) {
  if (state["sum"]) return "sum";
  return state["shift"] ? "shift" : "full";
}

std::string states_table(const Json& states) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::left, Align::left, Align::right, Align::right, Align::left});
  table.add({"state", "points", "unit", "table", "entries", "memory", "next value depends on"});
  for (const Json& state : states) {
    table.add({text_of(state["name"]), count_of(state["points"]), printable(text_of(state["unit"])),
               table_kind(state), count_of(state["table_entries"]),
               byte_size(state["table_bytes"].get<std::uint64_t>()), dependencies(state)});
  }
  return table.text();
}

std::string inputs_table(const Json& inputs) {
  Table table({Table::Align::left, Table::Align::right, Table::Align::left});
  table.add({"input", "points", "unit"});
  for (const Json& input : inputs)
    table.add({text_of(input["name"]), count_of(input["points"]), printable(text_of(input["unit"]))});
  return table.text();
}

/// All of a few, else how many and the first and last of them.
std::string partitions_text(const Json& names) {
  constexpr std::size_t kMost = 15;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names.get<std::vector<std::string>>(), ", "));
  return fmt::format("{}: {}, {}, ... {}", grouped(std::uint64_t{names.size()}), text_of(names[0]),
                     text_of(names[1]), text_of(names.back()));
}

std::string totals_table(const Json& report) {
  Table table({Table::Align::left, Table::Align::left});
  table.add({"cells", count_of(report["cells"])});
  table.add({"joint inputs", count_of(report["joint_inputs"])});
  table.add({"partitions", partitions_text(report["partitions"])});
  if (report.contains("modes"))
    table.add({"modes of the network", grouped(std::uint64_t{report["modes"].size()})});
  table.add({"reachable sets", report["exact"] ? "exact interval hulls" : "outward rounded"});
  table.add({"guarantee", guarantee_text(text_of(report["guarantee"]))});
  table.add({"memory of analyze", "about " + byte_size(report["memory_bytes"].get<std::uint64_t>())});
  return table.text();
}

std::string report_text(const Json& report) {
  return fmt::format("{}: the spec is valid\n\n{}\n{}\n{}", text_of(report["name"]),
                     states_table(report["states"]), inputs_table(report["inputs"]), totals_table(report));
}

struct ValidateOptions : CommonOptions {
  std::string spec;
  std::vector<SpecSetting> settings;
};

ExitCode run(const ValidateOptions& own) {
  if (own.max_memory) hold_to_memory(*own.max_memory, own.threads);
  // What cannot be analysed here need not be looked at closely.
  const std::optional<std::uint64_t> memory = own.memory();
  const ProblemSpec spec = load_spec(own.spec, own.settings, memory);
  const SpecReport report = inspect(spec, own.threads);
  if (!memory || report.memory_bytes <= *memory) {
    ThreadTeam team(own.threads);
    check_regions(spec, team);
  }
  print_answer(own, report_json(report), report_text);
  return ExitCode::success;
}

}  // namespace

Run declare_validate(Options& options) {
  const auto own = std::make_shared<ValidateOptions>();
  options.argument(own->spec, "SPEC", kSpecDescription);
  declare_settings(options, own->settings);
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq

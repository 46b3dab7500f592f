#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/advice.hpp"
#include "analysis/analyze.hpp"
#include "analysis/estimate_memory.hpp"
#include "analysis/estimate_seconds.hpp"
#include "answers/requirements/judge_requirements.hpp"
#include "app/commands/all.hpp"
#include "app/load_spec.hpp"
#include "app/option_values.hpp"
#include "app/print.hpp"
#include "app/render.hpp"
#include "app/reports.hpp"
#include "app/text.hpp"
#include "model/outside.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

Json state_json(const SpecReport::State& state) {
  Json json;
  json["name"] = state.name;
  json["unit"] = state.unit;
  json["points"] = state.points;
  json["outside"] = {{"below", outside_name(state.below)}, {"above", outside_name(state.above)}};
  json["depends_on"] =
      Json{{"states", state.states}, {"inputs", state.inputs}, {"disturbances", state.disturbances}};
  json["shift"] = state.shift;
  json["sum"] = state.sum;
  json["table_entries"] = state.table_entries;
  json["table_bytes"] = state.table_bytes;
  return json;
}

Json report_json(const SpecReport& report, const ProblemSpec& spec) {
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
  json["rows"] = Json{{"across", report.rows.across},
                      {"along", report.rows.along},
                      {"count", report.rows.sample.rows},
                      {"drawn", report.rows.sample.drawn},
                      {"different", report.rows.sample.different}};
  json["partitions"] = report.partitions;
  if (!report.modes.empty()) json["modes"] = report.modes;
  json["exact"] = report.exact;
  json["motion"] = motion_json(spec, report.motion);
  json["guarantee"] = report.guarantee;
  json["memory_bytes"] = report.memory_bytes;
  return json;
}

Json ranks_json(int ranks, const FullestRank& fullest) {
  return {{"ranks", ranks},
          {"rows", fullest.local_rows},
          {"halo_rows", fullest.ghost_rows},
          {"memory_bytes", fullest.memory_bytes}};
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

constexpr int kMostRanks = 10000;

using Align = Table::Align;

std::string name_of(const Json& entry) {
  return text_of(entry["name"]);
}

std::string points_of(const Json& entry) {
  return grouped(entry["points"]);
}

std::string unit_of(const Json& entry) {
  return line_of(entry["unit"]);
}

/// "10 cells (9.9 %)": in a period at most, and of the domain.
std::string motion_text(const Json& entry) {
  const auto cells = entry["cells"].get<double>();
  const std::string count = rough_amount(cells, cells == 1 ? "cell" : "cells");
  return fmt::format("{} ({} %)", count, rough_amount(100 * entry["share"].get<double>(), ""));
}

std::string states_table(const Json& states, const Json& motion, bool is_verbose) {
  std::size_t at = 0;
  std::vector<Column> columns = {
      {"state", Align::left, name_of},
      {"points", Align::right, points_of},
      {"unit", Align::left, unit_of},
      {"outside", Align::left, [](const Json& entry) { return sides_text(entry["outside"]); }},
      {"moves in a period at most", Align::left, [&](const Json&) { return motion_text(motion[at++]); }}};
  if (is_verbose) {
    columns.insert(
        columns.end(),
        {{"table", Align::left, table_kind},
         {"entries", Align::right, [](const Json& entry) { return grouped(entry["table_entries"]); }},
         {"memory", Align::right,
          [](const Json& entry) { return byte_size(entry["table_bytes"].get<std::uint64_t>()); }}});
  }
  columns.push_back({"next value depends on", Align::left, dependencies});
  return table_text(states, columns);
}

std::string inputs_table(const Json& inputs) {
  return table_text(
      inputs,
      {{"input", Align::left, name_of}, {"points", Align::right, points_of}, {"unit", Align::left, unit_of}});
}

/// All of a few, else how many and the first and last of them.
std::string partition_names(const Json& names) {
  constexpr std::size_t kMost = 15;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names.get<std::vector<std::string>>(), ", "));
  return fmt::format("{}: {}, {}, ... {}", grouped(std::uint64_t{names.size()}), text_of(names[0]),
                     text_of(names[1]), text_of(names.back()));
}

std::string rows_text(const Json& rows) {
  const auto names = [](const Json& list) {
    return fmt::format("{}", fmt::join(list.get<std::vector<std::string>>(), ", "));
  };
  const std::string across = rows["across"].empty() ? "" : "across " + names(rows["across"]) + ", ";
  return fmt::format("{}along {}; of {} drawn {} different", across, names(rows["along"]),
                     grouped(rows["drawn"]), grouped(rows["different"]));
}

/// To one digit: more would be a pretence.
std::string time_text(const Json& seconds) {
  if (seconds.is_null()) return "unknown";
  const auto value = seconds.get<double>();
  if (value < 1) return "less than a second";
  const double digit = std::pow(10, std::floor(std::log10(value)));
  return "about " + time_span(value < 60 ? std::round(value / digit) * digit : value);
}

std::string totals_table(const Json& report, const ProblemSpec& spec, bool is_verbose) {
  Facts facts = {{"cells", grouped(report["cells"])}, {"joint inputs", grouped(report["joint_inputs"])}};
  if (is_verbose) facts.emplace_back("rows", rows_text(report["rows"]));
  facts.emplace_back("partitions", partition_names(report["partitions"]));
  if (report.contains("modes"))
    facts.emplace_back("modes of the network", grouped(std::uint64_t{report["modes"].size()}));
  facts.insert(facts.end(),
               {{"reachable sets", report["exact"] ? "exact interval hulls" : "outward rounded"},
                {"guarantee", guarantee_line(text_of(report["guarantee"]), report["motion"], spec)},
                {"memory of analyze", "about " + byte_size(report["memory_bytes"].get<std::uint64_t>())},
                {"time of analyze", time_text(report["seconds"])}});
  if (report.contains("fullest_rank")) {
    const Json& rank = report["fullest_rank"];
    facts.emplace_back(fmt::format("fullest of {} ranks", rank["ranks"].get<int>()),
                       fmt::format("about {}, {} rows of its own and {} of others",
                                   byte_size(rank["memory_bytes"].get<std::uint64_t>()),
                                   grouped(rank["rows"]), grouped(rank["halo_rows"])));
  }
  return facts_text(facts);
}

std::string report_text(const Json& report, const ProblemSpec& spec, bool is_verbose) {
  return fmt::format("{}: the spec is valid\n\n{}\n{}\n{}", text_of(report["name"]),
                     states_table(report["states"], report["motion"], is_verbose),
                     inputs_table(report["inputs"]), totals_table(report, spec, is_verbose));
}

/// What cannot be analysed here is not looked at cell by cell.
Warning too_large_here(const SpecReport& report, std::uint64_t memory) {
  return {"memory", "/states",
          fmt::format("analyze needs about {}, and this machine has {}: motions and requirements were not "
                      "checked",
                      byte_size(report.memory_bytes), byte_size(memory))};
}

struct ValidateOptions : CommonOptions {
  std::string spec;
  std::vector<SpecSetting> settings;
  std::optional<int> ranks;
  std::int64_t posts = 1000;
  bool is_verbose = false;
};

/// What is found out about a spec.
Json inspected(const ProblemSpec& spec, const ValidateOptions& options) {
  const std::optional<std::uint64_t> memory = options.memory();
  const Model model = make_model(spec);
  const int threads =
      options.ranks ? options.threads : threads_within(model, options.max_memory, options.threads, false);
  const SpecReport report = inspect(model, threads);
  Json findings = report_json(report, spec);
  findings["seconds"] = nullptr;
  if (!memory || report.memory_bytes <= *memory) {
    ThreadTeam team(threads);
    if (const std::optional<double> seconds = options.quiet ? std::nullopt : estimate_seconds(model, team);
        seconds)
      findings["seconds"] = *seconds;
    check_regions(spec, team);
    findings["warnings"] = warnings_json(advise_before(model, report.motion, options.posts, team));
  } else {
    findings["warnings"] = warnings_json({too_large_here(report, *memory)});
  }
  if (options.ranks) {
    ThreadTeam team(options.threads);
    findings["fullest_rank"] =
        ranks_json(*options.ranks, inspect_ranks(model, *options.ranks, options.threads,
                                                 {.of_rank = options.max_memory, .here = memory}, team));
  }
  return findings;
}

ExitCode run(const ValidateOptions& options) {
  options.hold_to_memory();
  const ProblemSpec spec = load_spec(options.spec, options.settings, options.memory());
  const Json findings = with_places_in(spec, [&] { return inspected(spec, options); });
  PrintedWarnings(options).print(findings["warnings"]);
  print_answer(options, findings, [&](const Json& report_of_spec) {
    return report_text(report_of_spec, spec, options.is_verbose);
  });
  return ExitCode::success;
}

}  // namespace

Run declare_validate(Options& options) {
  const auto args = std::make_shared<ValidateOptions>();
  options.argument(args->spec, "SPEC", kSpecDescription);
  declare_settings(options, args->settings);
  options.option(args->ranks, "--ranks", "N",
                 "Also estimate the fullest of N processes of coordreq-mpi, each with --threads",
                 WholeNumber<int>{1, kMostRanks});
  options.option(args->posts, "--posts", "N",
                 "Compute N successor sets of a large problem, to find equations that are undefined "
                 "somewhere (default: 1000)",
                 WholeNumber<std::int64_t>{1, 1'000'000'000});
  options.flag(args->is_verbose, "--verbose", "Also show how tables and rows are stored");
  declare_common(options, *args);
  return [args] { return run(*args); };
}

}  // namespace coordreq

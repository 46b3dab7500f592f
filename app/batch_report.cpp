#include "app/batch_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/analyze_report.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

/// A figure of every partition: all of up to three, else the first and the last.
template <class Figure>
std::string of_partitions(const AnalysisSummary& summary, const Figure& figure) {
  constexpr std::size_t kMost = 3;
  const std::vector<PartitionSummary>& all = summary.partitions;
  if (all.size() > kMost) return fmt::format("{} ... {}", figure(all.front()), figure(all.back()));
  std::string text;
  for (const PartitionSummary& partition : all) text += (text.empty() ? "" : " / ") + figure(partition);
  return text;
}

std::string longest(const PartitionSummary& partition, const AnalysisSummary& summary) {
  const std::string text = longest_delay_text(partition, summary);
  return text.empty() ? "-" : text;
}

std::string requirements_met(const AnalysisSummary& summary) {
  if (summary.requirements.empty()) return "-";
  const auto met = std::count_if(summary.requirements.begin(), summary.requirements.end(),
                                 [](const ResultRequirement& own) { return own.holds; });
  return fmt::format("{} of {}", met, summary.requirements.size());
}

std::vector<std::string> figures(const AnalysisSummary& summary) {
  double seconds = 0;
  for (const auto& stage : summary.seconds) seconds += stage.second;
  return {grouped(summary.states),
          grouped(summary.safe),
          grouped(summary.invariant),
          of_partitions(summary, fixed_point_text),
          of_partitions(summary, unbounded_text),
          of_partitions(summary, [&](const PartitionSummary& own) { return longest(own, summary); }),
          requirements_met(summary),
          fmt::format("{:.2f}", seconds),
          byte_size(summary.peak_memory_bytes)};
}

/// What tells one run from the others.
std::vector<std::string> labels(const FinishedRun& run, bool has_path) {
  std::vector<std::string> result;
  if (has_path) result.push_back(printable(run.plan.path));
  for (const SpecSetting& value : run.plan.values) result.push_back(printable(value.value));
  return result;
}

std::string files_text(const std::vector<FinishedRun>& runs, const CommandLine& line) {
  const auto written = std::count_if(runs.begin(), runs.end(), [](const FinishedRun& run) {
    return run.summary && !run.plan.output.empty();
  });
  if (!line.output && !line.sweeps.empty()) return "\nno results files: --output names a folder for them\n";
  return fmt::format("\nresults in {} file{} in {}\n", grouped(std::int64_t{written}),
                     written == 1 ? "" : "s", line.output ? printable(*line.output) : "the current folder");
}

/// As JSON where it is some, else the text.
Json value_json(const std::string& value) {
  const Json json = Json::parse(value, nullptr, false);
  return json.is_discarded() ? Json(value) : json;
}

Json run_json(const FinishedRun& run) {
  Json json;
  json["spec"] = run.plan.path;
  json["values"] = Json::object();
  for (const SpecSetting& value : run.plan.values) json["values"][value.path] = value_json(value.value);
  json["exit_code"] = run.exit_code;
  if (run.failure) json["error"] = run.failure->what;
  if (run.summary) json["summary"] = summary_json(*run.summary, *run.plan.spec);
  return json;
}

}  // namespace

int worst_exit_code(const std::vector<FinishedRun>& runs) {
  int worst = 0;
  for (const FinishedRun& run : runs) worst = std::max(worst, run.exit_code);
  return worst;
}

std::string batch_text(const std::vector<FinishedRun>& runs, const CommandLine& line) {
  using Align = Table::Align;
  const bool has_path = line.paths.size() > 1;
  std::vector<std::string> heading;
  if (has_path) heading.emplace_back("spec");
  for (const Sweep& sweep : line.sweeps) heading.push_back(printable(sweep.path));
  std::vector<Align> columns(heading.size(), Align::left);
  const std::vector<std::string> names = {
      "cells",   "safe",  "invariant", "F", "unbounded", "longest finite delay", "requirements met",
      "seconds", "memory"};
  for (const std::string& name : names) {
    heading.push_back(name);
    columns.push_back(name == "longest finite delay" ? Align::left : Align::right);
  }
  Table table(columns);
  table.add(heading);
  for (const FinishedRun& run : runs) {
    std::vector<std::string> row = labels(run, has_path);
    if (run.summary) {
      for (std::string& figure : figures(*run.summary)) row.push_back(std::move(figure));
    } else {
      row.push_back("error: " + run.failure->what);
    }
    table.add(std::move(row));
  }
  return table.text() + files_text(runs, line);
}

std::string batch_json(const std::vector<FinishedRun>& runs) {
  Json json;
  json["runs"] = Json::array();
  for (const FinishedRun& run : runs) json["runs"].push_back(run_json(run));
  json["exit_code"] = worst_exit_code(runs);
  return json_text(json);
}

}  // namespace coordreq

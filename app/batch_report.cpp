#include "app/batch_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/answers/all.hpp"
#include "app/render.hpp"
#include "app/reports.hpp"
#include "app/requirement_text.hpp"
#include "base/json.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Figures of partitions in one cell: all of up to three, else the first and the last.
std::string joined(const std::vector<std::string>& figures) {
  constexpr std::size_t kMost = 3;
  if (figures.size() > kMost) return fmt::format("{} ... {}", figures.front(), figures.back());
  return fmt::format("{}", fmt::join(figures, " / "));
}

template <class Figure>
std::string of_partitions(const Json& summary, const Figure& figure) {
  std::vector<std::string> figures;
  for (const Json& partition : summary["partitions"]) figures.push_back(figure(partition));
  return joined(figures);
}

std::string longest(const Json& partition, const Json& summary) {
  const std::string text = longest_delay_text(partition, summary);
  return text.empty() ? "-" : text;
}

std::string requirements_that_hold(const Json& summary) {
  const Json& all = summary["requirements"];
  if (all.empty()) return "-";
  const auto holding =
      std::count_if(all.begin(), all.end(), [](const Json& entry) { return entry["holds"].get<bool>(); });
  return fmt::format("{} of {}", holding, all.size());
}

/// Columns of every run; those that only some runs have stand before the last.
constexpr const char* kFigures[] = {"cells",   "safe",   "invariant", "requirements met",
                                    "seconds", "memory", "F",         "unbounded"};
constexpr const char* kLastFigure = "longest finite delay";

std::vector<std::string> figures(const Json& summary, const RunFigures& more, const ProblemSpec& spec) {
  const auto count = [&summary](const char* key) { return grouped(summary[key].get<std::int64_t>()); };
  std::vector<std::string> result = {count("cells"),
                                     count("safe"),
                                     count("invariant"),
                                     requirements_that_hold(summary),
                                     fmt::format("{:.2f}", seconds_of(summary)),
                                     byte_size(summary["peak_memory_bytes"].get<std::uint64_t>()),
                                     of_partitions(summary, fixed_point_text),
                                     of_partitions(summary, unbounded_text)};
  for (const RunFigure& figure : more) result.push_back(figure.is_of(spec) ? figure.text(summary) : "-");
  result.push_back(of_partitions(summary, [&](const Json& entry) { return longest(entry, summary); }));
  return result;
}

/// Figures as wide as those of an analysis can be, or will hardly ever be.
std::vector<std::string> wide_figures(const ProblemSpec& spec, const RunFigures& more) {
  const std::string cells = grouped(spec.cells());
  const bool may_stop = spec.coordination.max_delay.has_value();
  const auto of_all = [&spec](const std::string& figure) {
    return joined(std::vector<std::string>(spec.coordination.partitions.size(), figure));
  };
  const std::string all_hold = std::to_string(spec.requirements.size());
  std::vector<std::string> result = {cells,
                                     cells,
                                     cells,
                                     all_hold + " of " + all_hold,
                                     "12345.67",
                                     "1023 MiB",
                                     of_all(may_stop ? "not reached" : "1234"),
                                     of_all(may_stop && cells.size() < 7 ? "unknown" : cells)};
  for (const RunFigure& figure : more) result.emplace_back(figure.widest);
  result.emplace_back();
  return result;
}

/// Columns that the spec of some run asks for.
RunFigures figures_of_some(const std::vector<PlannedRun>& runs) {
  RunFigures result;
  std::copy_if(run_figures().begin(), run_figures().end(), std::back_inserter(result),
               [&runs](const RunFigure& figure) {
                 return std::any_of(runs.begin(), runs.end(), [&figure](const PlannedRun& run) {
                   return run.spec && figure.is_of(*run.spec);
                 });
               });
  return result;
}

/// The values that distinguish one run from the others.
std::vector<std::string> labels(const PlannedRun& run, bool has_path) {
  std::vector<std::string> result;
  if (has_path) result.push_back(printable(run.path));
  for (const SpecSetting& value : run.values) result.push_back(printable(value.value));
  return result;
}

std::vector<std::string> column_names(const AnalyzeOptions& args, bool has_path, const RunFigures& more) {
  std::vector<std::string> names;
  if (has_path) names.emplace_back("spec");
  for (const Sweep& sweep : args.sweeps) names.push_back(printable(sweep.path));
  names.insert(names.end(), std::begin(kFigures), std::end(kFigures));
  for (const RunFigure& figure : more) names.emplace_back(figure.name);
  names.emplace_back(kLastFigure);
  return names;
}

/// Labels and the last column to the left, figures to the right.
std::vector<Table::Align> alignment(std::size_t labels, std::size_t columns) {
  std::vector<Table::Align> result(columns, Table::Align::right);
  std::fill_n(result.begin(), labels, Table::Align::left);
  result.back() = Table::Align::left;
  return result;
}

/// The value parsed as JSON, or the text if it is none.
Json value_json(const std::string& value) {
  const Json json = parse_json_if_valid(value);
  return json.is_discarded() ? Json(value) : json;
}

Json run_json(const FinishedRun& run) {
  Json json;
  json["spec"] = run.plan->path;
  json["values"] = Json::object();
  for (const SpecSetting& value : run.plan->values) json["values"][value.path] = value_json(value.value);
  json["exit_code"] = run.exit_code;
  if (run.failure) json["error"] = run.failure->what;
  if (run.summary) json["summary"] = *run.summary;
  return json;
}

/// Lines about one requirement; of further runs only the number is printed.
constexpr std::size_t kMostFailures = 10;

/// A requirement of some runs, and why it fails in them.
struct FailedRequirement {
  std::string claim;
  std::vector<std::string> failures;
};

void add_failure(const std::string& claim, const std::string& failure,
                 std::vector<FailedRequirement>& failed) {
  const auto known = std::find_if(failed.begin(), failed.end(),
                                  [&](const FailedRequirement& other) { return other.claim == claim; });
  FailedRequirement& requirement =
      known == failed.end() ? failed.emplace_back(FailedRequirement{claim, {}}) : *known;
  requirement.failures.push_back(failure);
}

}  // namespace

int worst_exit_code(const std::vector<FinishedRun>& runs) {
  int worst = 0;
  for (const FinishedRun& run : runs) worst = std::max(worst, run.exit_code);
  return worst;
}

BatchTable::BatchTable(const std::vector<PlannedRun>& runs, const AnalyzeOptions& args)
    : has_path_(args.specs.size() > 1), more_(figures_of_some(runs)), table_({}) {
  const std::vector<std::string> names = column_names(args, has_path_, more_);
  table_ = Table(alignment((has_path_ ? 1 : 0) + args.sweeps.size(), names.size()));
  table_.add(names);
  for (const PlannedRun& run : runs) {
    std::vector<std::string> row = labels(run, has_path_);
    if (run.spec) {
      const std::vector<std::string> wide = wide_figures(*run.spec, more_);
      row.insert(row.end(), wide.begin(), wide.end());
    } else {
      row.emplace_back();  // for the error, which has no column
    }
    table_.widen(row);
  }
}

std::string BatchTable::row(const FinishedRun& run) const {
  std::vector<std::string> row = labels(*run.plan, has_path_);
  if (run.summary) {
    const std::vector<std::string> cells = figures(*run.summary, more_, *run.plan->spec);
    row.insert(row.end(), cells.begin(), cells.end());
  } else {
    row.push_back("error: " + run.failure->what);
  }
  return table_.line(row);
}

std::string failures_text(const std::vector<FinishedRun>& runs) {
  std::vector<FailedRequirement> failed;
  for (const FinishedRun& run : runs) {
    if (!run.summary) continue;
    for (const Json& entry : (*run.summary)["requirements"]) {
      const ProblemSpec& spec = *run.plan->spec;
      if (!entry["holds"].get<bool>())
        add_failure(fmt::format("requirement {}: {}", line_of(entry["name"]), claim_text(entry, spec)),
                    fmt::format("{}: {}", printable(run_label(*run.plan)), failure_line(entry, spec)),
                    failed);
    }
  }
  std::string text;
  for (const FailedRequirement& requirement : failed) {
    text += "\n" + requirement.claim + "\n";
    const std::size_t listed = std::min(requirement.failures.size(), kMostFailures);
    for (std::size_t i = 0; i < listed; ++i) text += "  FAILS in " + requirement.failures[i] + ".\n";
    if (const std::size_t more = requirement.failures.size() - listed; more > 0)
      text += fmt::format("  FAILS in {} more of the {} runs.\n", grouped(std::uint64_t{more}),
                          grouped(std::uint64_t{runs.size()}));
  }
  return text;
}

std::string closing_text(const std::vector<FinishedRun>& runs, const AnalyzeOptions& args) {
  const auto written = std::count_if(runs.begin(), runs.end(), [](const FinishedRun& run) {
    return run.summary && !run.plan->output.empty();
  });
  if (!args.output && !args.sweeps.empty()) return "\nno results files: --output names a folder for them\n";
  return fmt::format("\nresults in {} file{} in {}\n", grouped(std::int64_t{written}),
                     written == 1 ? "" : "s", args.output ? printable(*args.output) : "the current folder");
}

std::string batch_json(const std::vector<FinishedRun>& runs) {
  Json json;
  json["runs"] = Json::array();
  for (const FinishedRun& run : runs) json["runs"].push_back(run_json(run));
  json["exit_code"] = worst_exit_code(runs);
  return json_text(json);
}

}  // namespace coordreq

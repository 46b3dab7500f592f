#include "app/batch_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "app/files_in_use.hpp"
#include "app/load_spec.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;

void read_into(PlannedRun& run, const SpecSource& source, std::vector<SpecSetting> settings) {
  settings.insert(settings.end(), run.values.begin(), run.values.end());
  try {
    run.spec = read_with_settings(source, settings);
  } catch (...) {
    run.failure = describe_current_exception();
  }
}

/// The runs of one spec.
void add_runs(const AnalyzeOptions& asked, const std::string& path,
              const std::vector<std::vector<SpecSetting>>& values, std::vector<PlannedRun>& runs) {
  std::optional<SpecSource> source;
  std::optional<Failure> failure;
  try {
    source = load_source(path, asked.memory());
  } catch (...) {
    failure = describe_current_exception();
  }
  for (const std::vector<SpecSetting>& combination : values) {
    runs.push_back({.path = path, .values = combination, .failure = failure});
    if (source) read_into(runs.back(), *source, asked.settings);
  }
}

/// A text as a part of a file name: letters, digits and a few signs that need no quotes anywhere.
std::string file_part(const std::string& text) {
  std::string part = text;
  for (char& c : part) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string_view(".+-=").find(c) != std::string_view::npos;
    if (!plain) c = '_';
  }
  return part;
}

/// "circle.h5", "circle_constants.R=0.7.h5"
std::string results_name(const PlannedRun& run) {
  std::string name = run.spec->name;
  for (const SpecSetting& value : run.values) name += "_" + file_part(value.path + "=" + value.value);
  return name + ".h5";
}

void check_folder(const std::string& path) {
  std::error_code ignored;  // what cannot be examined is no folder that could be written to
  if (fs::is_directory(path, ignored)) return;
  throw UsageError(
      fmt::format("expected a folder that exists, because there are several results files, found {}",
                  echoed(path)),
      "--output");
}

/// @throws UsageError if a file would take the place of another
void check_files(const std::vector<PlannedRun>& runs, const AnalyzeOptions& asked) {
  FilesInUse files;
  for (const PlannedRun& run : runs) add_read_files(run.path, run.spec ? &*run.spec : nullptr, files);
  for (const PlannedRun& run : runs) {
    if (!run.output.empty()) files.writes(run.output, "the results of " + run_label(run), "--output");
  }
  if (asked.junit) files.writes(*asked.junit, "the JUnit report", "--junit");
}

/// Names of several files are never typed. @throws UsageError
void check_replaced(const std::vector<PlannedRun>& runs) {
  for (const PlannedRun& run : runs)
    if (run.spec && !run.output.empty()) check_replaces_own_results(run.output, *run.spec);
}

std::string swept_values(const PlannedRun& run) {
  std::string text;
  for (const SpecSetting& value : run.values) text += fmt::format(" {}={}", value.path, value.value);
  return text;
}

}  // namespace

std::string run_label(const PlannedRun& run) {
  return run.path + swept_values(run);
}

std::string run_name(const PlannedRun& run) {
  return (run.spec ? run.spec->name : run.path) + swept_values(run);
}

std::vector<PlannedRun> plan_runs(const AnalyzeOptions& asked) {
  if (std::count(asked.specs.begin(), asked.specs.end(), "-") > 1) {
    throw UsageError("standard input is named twice, expected one spec from it");
  }
  const std::vector<std::vector<SpecSetting>> values = combinations(asked.sweeps);
  if (asked.output) check_folder(*asked.output);
  std::vector<PlannedRun> runs;
  for (const std::string& path : asked.specs) add_runs(asked, path, values, runs);
  const bool writes = asked.output || asked.sweeps.empty();
  for (PlannedRun& run : runs) {
    if (writes && run.spec) run.output = (fs::path(asked.output.value_or("")) / results_name(run)).string();
  }
  check_files(runs, asked);
  if (asked.is_first() && !asked.is_forced) check_replaced(runs);
  return runs;
}

}  // namespace coordreq

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
void add_runs(const AnalyzeOptions& args, const std::string& path,
              const std::vector<std::vector<SpecSetting>>& values, std::vector<PlannedRun>& runs) {
  std::optional<SpecSource> source;
  std::optional<Failure> failure;
  try {
    source = load_source(path, args.memory());
  } catch (...) {
    failure = describe_current_exception();
  }
  for (const std::vector<SpecSetting>& combination : values) {
    runs.push_back({.path = path, .values = combination, .failure = failure});
    if (source) read_into(runs.back(), *source, args.settings);
  }
}

/// A text as it may stand in a file name: letters, digits and a few signs that need no quotes anywhere.
std::string file_name_of(const std::string& text) {
  std::string name = text;
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string_view(".+-=").find(c) != std::string_view::npos;
    if (!plain) c = '_';
  }
  return name;
}

/// "circle.h5", "circle_constants.R=0.7.h5"
std::string results_name(const PlannedRun& run) {
  std::string name = run.spec->name;
  for (const SpecSetting& value : run.values) name += "_" + file_name_of(value.path + "=" + value.value);
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

/// @throws UsageError if a file would replace another
void check_files(const std::vector<PlannedRun>& runs, const AnalyzeOptions& args) {
  FilesInUse files;
  for (const PlannedRun& run : runs) add_read_files(run.path, run.spec ? &*run.spec : nullptr, files);
  for (const PlannedRun& run : runs) {
    if (!run.output.empty()) files.writes(run.output, "the results of " + run_label(run), "--output");
  }
  if (args.junit) files.writes(*args.junit, "the JUnit report", "--junit");
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

std::vector<PlannedRun> plan_runs(const AnalyzeOptions& args) {
  if (std::count(args.specs.begin(), args.specs.end(), "-") > 1) {
    throw UsageError("standard input is named twice, expected one spec from it");
  }
  const std::vector<std::vector<SpecSetting>> values = combinations(args.sweeps);
  if (args.output) check_folder(*args.output);
  std::vector<PlannedRun> runs;
  for (const std::string& path : args.specs) add_runs(args, path, values, runs);
  const bool writes = args.output || args.sweeps.empty();
  for (PlannedRun& run : runs) {
    if (writes && run.spec) run.output = (fs::path(args.output.value_or("")) / results_name(run)).string();
  }
  check_files(runs, args);
  if (args.is_first() && !args.is_forced) check_replaced(runs);
  return runs;
}

}  // namespace coordreq

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/analyze_options.hpp"
#include "app/report_error.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// One of several analyses.
struct PlannedRun {
  std::string path;                 ///< of the spec, as given
  std::vector<SpecSetting> values;  ///< of the swept places
  std::optional<ProblemSpec> spec;  ///< none if `failure` says why
  std::optional<Failure> failure;   ///< of reading the spec
  std::string output;               ///< path of the results file; empty: none
};

/// "a.json", "a.json constants.R=0.7 states.0.step=0.02": what a run is called.
[[nodiscard]] std::string run_label(const PlannedRun& run);

/// The name for reports: of the spec, else its path, with the swept values.
[[nodiscard]] std::string run_name(const PlannedRun& run);

/// Every spec with every combination of swept values, read and checked. What is wrong with one spec is noted
/// with its run.
/// @throws UsageError if a run would write what another reads or writes, or `--output` is no folder, before
///   anything is analysed
[[nodiscard]] std::vector<PlannedRun> plan_runs(const AnalyzeOptions& args);

}  // namespace coordreq

#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "app/analyze_options.hpp"
#include "app/batch_report.hpp"

namespace coordreq {

/// Does the runs that have a spec, in any order, and reports each that is `done`.
using BatchWork = std::function<void(const std::vector<PlannedRun>& plan, const AnalyzeOptions& args,
                                     const std::function<void(std::size_t run, RunOutcome outcome)>& done)>;

/// One analysis, with what it throws. @throws Error if the program was interrupted
[[nodiscard]] RunOutcome outcome_of(const ProblemSpec& spec, const std::string& output,
                                    const AnalyzeOptions& args, const std::string& prefix);

/// In the order of the plan.
void one_after_the_other(const std::vector<PlannedRun>& plan, const AnalyzeOptions& args,
                         const std::function<void(std::size_t run, RunOutcome outcome)>& done);

/// `analyze` of several specs, or with swept values: a line each, in the order of the plan. One that fails
/// does not stop the others.
/// @returns the largest exit code of them. @throws as plan_runs(); IoError
[[nodiscard]] ExitCode run_analyze_batch(const AnalyzeOptions& args,
                                         const BatchWork& work = one_after_the_other);

}  // namespace coordreq

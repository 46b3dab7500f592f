#pragma once

#include <memory>
#include <string>

#include "app/analyze_options.hpp"
#include "base/json.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// One analysis, interruptible, with its progress on standard error.
/// @returns its summary. @param output path of the results file; empty: none
/// @param prefix of the progress line: "2 of 5, "
/// @throws LimitError if it needs more memory than there may be, before threads or anything else are there;
///   as analyze(); Error if the program was interrupted
[[nodiscard]] std::shared_ptr<const Json> analyze_with_progress(const ProblemSpec& spec,
                                                                const std::string& output,
                                                                const AnalyzeOptions& args,
                                                                const std::string& prefix);

/// One analysis as `analyze` does it: no file replaces another, and what it finds is written
/// and printed, by the first process.
[[nodiscard]] ExitCode analyze_and_print(const ProblemSpec& spec, const AnalyzeOptions& options);

/// @throws Error if a signal waits. @param location what is complete nevertheless
void check_interrupted(const std::string& location);

/// check_writable(), during which a signal waits. @throws IoError
void try_to_write(const std::string& path);

/// Success, or requirement_failed.
[[nodiscard]] ExitCode verdict(const Json& summary);

}  // namespace coordreq

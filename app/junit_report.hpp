#pragma once

#include <string>

#include "analysis/analyze.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The requirements as a JUnit report, which CI systems show: a test suite for the spec, a test case for each
/// requirement, a failure with the story of the counterexample for one that fails.
[[nodiscard]] std::string junit_text(const AnalysisSummary& summary, const ProblemSpec& spec);

/// Writes it to a file that appears whole or not at all. @throws IoError
void write_junit(const std::string& path, const AnalysisSummary& summary, const ProblemSpec& spec);

}  // namespace coordreq

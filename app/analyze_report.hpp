#pragma once

#include <string>

#include "analysis/analyze.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// What `analyze` prints for people.
[[nodiscard]] std::string summary_text(const AnalysisSummary& summary, const ProblemSpec& spec);

/// What `analyze --json` prints: one document, keys in a fixed order, ending in a newline.
[[nodiscard]] std::string summary_json(const AnalysisSummary& summary, const ProblemSpec& spec);

}  // namespace coordreq

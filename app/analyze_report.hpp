#pragma once

#include <string>

#include "analysis/analyze.hpp"
#include "app/json_text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// What `analyze` prints for people.
[[nodiscard]] std::string summary_text(const AnalysisSummary& summary, const ProblemSpec& spec);

/// What `analyze --json` prints.
[[nodiscard]] Json summary_json(const AnalysisSummary& summary, const ProblemSpec& spec);

/// Figures of a partition in tables: F, |Z_F|, and the largest delay of the cells that have a finite one,
/// which is empty if none has.
[[nodiscard]] std::string fixed_point_text(const PartitionSummary& partition);
[[nodiscard]] std::string unbounded_text(const PartitionSummary& partition);
[[nodiscard]] std::string longest_delay_text(const PartitionSummary& partition,
                                             const AnalysisSummary& summary);

}  // namespace coordreq

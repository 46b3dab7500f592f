#pragma once

#include <string>

#include "analysis/analyze.hpp"
#include "app/json_text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// "delay of alone >= 20 steps (0.2 s)", "in the invariance set": what a requirement asks of each cell of its
/// region.
[[nodiscard]] std::string requirement_claim(const RequirementSpec& requirement, const ProblemSpec& spec);

/// Why a requirement fails, with the story of its counterexample: lines that end in newlines. Empty if it
/// holds.
[[nodiscard]] std::string failure_text(const ResultRequirement& result, const RequirementSpec& requirement,
                                       const ProblemSpec& spec);
/// The same in one line, without the story.
[[nodiscard]] std::string failure_line(const ResultRequirement& result, const ProblemSpec& spec);

/// What is the matter with the worst cell: "has a delay of 2 steps (1 s)", "is not safe". REQUIRES: `delay`
/// as in `/delay`, not unbounded.
[[nodiscard]] std::string worst_text(std::int32_t delay, const ProblemSpec& spec);
/// Where the region may reach. REQUIRES: result.reached_side.
[[nodiscard]] std::string outside_text(const ResultRequirement& result, const ProblemSpec& spec);

/// What `analyze` prints about the requirements; empty if there are none.
[[nodiscard]] std::string requirements_text(const AnalysisSummary& summary, const ProblemSpec& spec);

/// The `requirements` of the JSON summary.
[[nodiscard]] Json requirements_json(const AnalysisSummary& summary, const ProblemSpec& spec);

/// A delay as in `/delay`: the number of steps, else null.
[[nodiscard]] Json delay_json(std::int32_t delay);
/// "steps", "unbounded", "not_invariant" or "not_safe".
[[nodiscard]] std::string delay_word(std::int32_t delay);

}  // namespace coordreq

#pragma once

#include <cstdint>

#include "analysis/analyze.hpp"
#include "app/json_text.hpp"
#include "spec/problem_spec.hpp"

// What has been found, as data: what `--json` prints, and what every text is made of.
namespace coordreq {

/// Of an analysis; contract, section 3.
[[nodiscard]] Json summary_json(const AnalysisSummary& summary, const ProblemSpec& spec);

/// Of one requirement, with the story of its counterexample.
[[nodiscard]] Json requirement_json(const ResultRequirement& result, const RequirementSpec& asked,
                                    const ProblemSpec& spec);

/// A delay as in `/delay`: the number of steps, else null.
[[nodiscard]] Json delay_json(std::int32_t delay);
/// "steps", "unbounded", "not_invariant" or "not_safe".
[[nodiscard]] const char* delay_word(std::int32_t delay);

}  // namespace coordreq

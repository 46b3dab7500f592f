#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
#include "answers/memory_need.hpp"
#include "answers/risk/risk_figures.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"

namespace coordreq {

/// The risk, and its figures in each mode.
struct RiskAnswer {
  Risk risk;
  std::vector<RiskFigures> figures;  ///< [mode]
};

/// Adds RiskAnswer, if the spec asks for it: "risk".
[[nodiscard]] std::vector<Stage> risk_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed risk_memory(const EngineSizes& sizes, int threads);
void summarise_risk(const Answers& answers, Json& summary, Json& work);
/// Fails if the rate is no probability.
void examine_risk(const ProblemSpec& spec, const FieldSource& source);
void tell_risk(const ProblemSpec& spec, const FieldSource& source, Json& info);

}  // namespace coordreq

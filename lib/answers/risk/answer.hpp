#pragma once

#include <optional>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
#include "answers/memory_need.hpp"
#include "answers/risk/risk_figures.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"
#include "spec/coordination_spec.hpp"

namespace coordreq {

/// The risk, and its figures in each mode.
struct RiskAnswer {
  Risk risk;
  std::vector<RiskFigures> figures;  ///< [mode]
  /// The risk before the mode of the first step is drawn, E_q V_N of the mode q in which the network begins;
  /// if it is.
  std::optional<RiskRows> drawn = {};
  std::optional<RiskFigures> drawn_figures = {};

  /// The risk where the network starts.
  [[nodiscard]] const RiskRows& start(const RiskSpec& spec) const {
    return drawn ? *drawn : risk.risks[spec.start];
  }
};

/// Adds RiskAnswer, if the spec asks for it: "risk".
[[nodiscard]] std::vector<Stage> risk_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed risk_memory(const EngineSizes& sizes, int threads);
void summarise_risk(const Answers& answers, Json& summary, Json& work);
/// Fails if the rate is no probability.
void examine_risk(const ProblemSpec& spec, const FieldSource& source);
void tell_risk(const ProblemSpec& spec, const FieldSource& source, Json& info);

}  // namespace coordreq

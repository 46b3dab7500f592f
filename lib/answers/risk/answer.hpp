#pragma once

#include <optional>
#include <vector>

#include "answers/answer.hpp"
#include "answers/risk/risk_figures.hpp"
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

extern const Answer risk_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields risk_fields(const ProblemSpec& spec);
void fill_risk_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq

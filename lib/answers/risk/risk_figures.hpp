#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "answers/risk/risk.hpp"

namespace coordreq {

/// Figures of the risks in K in one mode, of all processes.
struct RiskFigures {
  /// Thresholds of `within`: 0, 1e-12, 1e-11, ..., 1e-1.
  static constexpr std::size_t kThresholds = 13;
  std::optional<float> worst;                         ///< nothing: K is empty
  std::optional<double> mean;                         ///< likewise
  std::array<std::int64_t, kThresholds> within = {};  ///< cells with a risk of at most so much
};

/// Together. The same for any number of processes and threads.
[[nodiscard]] RiskFigures risk_figures(const RiskRows& risks, const CellSet& invariant, const RowShare* share,
                                       ThreadTeam& team);

}  // namespace coordreq

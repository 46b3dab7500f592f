#pragma once

#include <optional>

#include "answers/blind/silent_table.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "engine/row_hull.hpp"

namespace coordreq {

/// The inputs to find the layers B of a partition of several classes (contract, section 8).
struct BlindProblem {
  const SilentSources& sources;
  const RowHull& hull;
  const DelayLayers& layers;  ///< Z
  std::optional<std::int64_t> max_delay;
  bool interned = false;              ///< whether equal rows are held once
  const CellSet* terminal = nullptr;  ///< G of a goal that ends the task, in every B_k; null: there is none
};

/// B_0 = K, B_1 (find_common_cells()), and from there on the operator of Z. Together.
///
/// B_k is a part of Z_k, and a cell outside B_1 keeps level 1, so that the ordinary wave finds the
/// layers from the levels of Z, lowered to 1 outside B_1. Where B_1 = Z_1 the levels are those of Z.
[[nodiscard]] LevelMap find_blind_levels(const BlindProblem& problem, const WaveWatch& watch,
                                         ThreadTeam& team, WaveCounts& counts);

/// blind_delay + 1 of the cells of K, in own rows: one more than the number of sets B_0, B_1, ... that hold
/// all posts under IND_C; kTop if all of these sets do, 0 outside K. No more than `max_delay` steps count:
/// where B is empty after so many, what leads to T alone has a delay of `max_delay`.
/// @param levels of B @param fixed_point F_b; -1: not known
[[nodiscard]] LevelMap find_blind_delays(const BlindProblem& problem, const LevelMap& levels,
                                         std::int64_t fixed_point, ThreadTeam& team);

}  // namespace coordreq

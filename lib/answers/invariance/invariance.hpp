#pragma once

#include <cstdint>

#include "base/thread_team.hpp"
#include "engine/action_groups.hpp"
#include "engine/level_map.hpp"
#include "engine/wave.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The invariance set K, and when each cell is lost; contract "Controller".
struct Invariance {
  CellSet invariant;       ///< in the rows held
  std::int64_t cells = 0;  ///< |K|
  /// [cells]: 0 outside S, i if the i-th sweep of the synchronous iteration removes the cell, LevelMap::kTop
  /// in K.
  LevelMap collision_time;
  std::int64_t iterations = 0;  ///< synchronous sweeps, the confirming last one included
  WaveCounts counts;
};

/// The collision times of K: for `maximal` the greatest K with K = {x in K n S : some allowed u has
/// empty != f(x,u) subset of K}; for `given` the limit of SPRE_S^i(X), C(x) being all that `allow` permits
/// (paper, Eq. (10) and Lemma 1). With a goal that ends the task all cells of G belong to every set.
/// @param equal without `numbers` those of the tables are taken
/// @param terminal G, a part of S; null: no goal ends the task
[[nodiscard]] LevelMap find_collision_times(const RowEngine& engine, const RowHull& hull, const CellSet& safe,
                                            Synthesis synthesis, const WaveWatch& watch, ThreadTeam& team,
                                            WaveCounts& counts, const EqualWork& equal = {},
                                            const CellSet* terminal = nullptr);

/// Fills in the members that follow from the collision times.
void follow_from_collision_times(Invariance& invariance, ThreadTeam& team);

/// Both of them.
[[nodiscard]] Invariance find_invariance(const RowEngine& engine, const RowHull& hull, const CellSet& safe,
                                         Synthesis synthesis, const WaveWatch& watch, ThreadTeam& team,
                                         const EqualWork& equal = {}, const CellSet* terminal = nullptr);

}  // namespace coordreq

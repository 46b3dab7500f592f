#pragma once

#include <optional>

#include "answers/countdown/delay_layers.hpp"
#include "answers/goal/progress_engine.hpp"
#include "choices/projections.hpp"

namespace coordreq {

/// The inputs to find the approach layers of all partitions.
struct ApproachSets {
  const ProgressEngine* progress = nullptr;
  const LevelMap* nearness = nullptr;
  const CellSet* goal = nullptr;  ///< G, where layers are those of safety; null: nowhere, the goal is lasting
  const CellSet* outside_goal = nullptr;  ///< W \ G; of a lasting goal W
  const LevelMap* bounds = nullptr;       ///< Controller::bounds
};

/// The levels of layers in W \ G, where agents that act alone must come nearer to the goal with every step;
/// in G the layers are those of safety (contract, section 5). DelayLayers::layers_of is 0 outside W. Of a
/// lasting goal the layers rest on nothing but P, in G too (section 11).
///
/// Whether all of IND_P comes nearer does not depend on layers, and is found once: a cell where some choice
/// does not come nearer keeps level 1, and cells of G keep the levels of safety; the ordinary wave
/// finds the levels of the other cells. (Where all choices come nearer no post leaves through a `safe` side,
/// so that one engine is enough.)
/// @param projections of P
/// @param layers of safety, of the partition
[[nodiscard]] LevelMap find_approach_levels(const ApproachSets& sets, const Projections& projections,
                                            const DelayLayers& layers, std::optional<std::int64_t> max_delay,
                                            const WaveWatch& watch, ThreadTeam& team, WaveCounts& counts);

}  // namespace coordreq

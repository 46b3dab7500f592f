#pragma once

#include <optional>

#include "answers/goal/progress_engine.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/layers/projections.hpp"

namespace coordreq {

/// What approach layers of all partitions are made of.
struct ApproachSets {
  const ProgressEngine* progress = nullptr;
  const LevelMap* nearness = nullptr;
  const CellSet* goal = nullptr;  ///< G
  const CellSet* away = nullptr;  ///< W \ G
};

/// Layers in W \ G, where agents that act alone must come nearer to the goal with every step; in G the layers
/// are those of safety (contract, section 5). DelayLayers::layers_of is 0 outside W.
///
/// Whether all of IND_P comes nearer does not depend on layers. It is asked once: a cell where it does not
/// has level 1, for ever, and those in G keep theirs, so that of the others the ordinary wave finds the rest.
/// (Where all come nearer no post leaves through a `safe` side, so that one engine will do.)
/// @param projections of P
/// @param layers of the partition
[[nodiscard]] DelayLayers find_approach_layers(const ApproachSets& sets, const Projections& projections,
                                               const DelayLayers& layers,
                                               std::optional<std::int64_t> max_delay, const WaveWatch& watch,
                                               ThreadTeam& team);

/// Fills in all that follows from the levels. A_k = A_{k+1} is the end only where Z_k = Z_{k+1} too.
void follow_from_approach(const DelayLayers& layers, std::optional<std::int64_t> max_delay, ThreadTeam& team,
                          DelayLayers& approach);

}  // namespace coordreq

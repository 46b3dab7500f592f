#pragma once

#include <cstdint>
#include <vector>

#include "answers/coalition/coalition_cost.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_map.hpp"

namespace coordreq {

/// Who must talk to whom: for each cell x of K the most preferred partition P with delay_P(x) >= horizon,
/// that is, the cheapest network with which the system stays in K for `horizon` steps though its classes do
/// not receive messages from one another.
struct CoalitionMap {
  std::int64_t horizon = 0;              ///< steps
  std::vector<CoalitionChoice> choices;  ///< the partitions, the most preferred first
  std::vector<AgentPair> pairs;          ///< all pairs of agents
  /// [cells]: 0 outside K, 1 + i where choices[i] is the first partition whose delay is enough,
  /// LevelMap::kTop where no partition's is. If one of the partitions has all agents in one class there is no
  /// such cell.
  LevelMap chosen;
  /// [pair]: the cells at which the two agents are together in every partition whose delay is enough and that
  /// costs as little as the chosen one. Empty outside K and where none is enough.
  std::vector<CellSet> critical;
  std::vector<std::int64_t> cells;           ///< [choice] number of cells with that choice
  std::int64_t without = 0;                  ///< cells of K for which no partition is enough
  std::vector<std::int64_t> critical_cells;  ///< [pair] |critical|
};

/// Delays that `max_delay` cut off count as lower bounds, so that a cell is never given a partition that has
/// not been shown to be enough.
/// @param layers of the partitions of `coordination`, in its order
/// @pre coordination.horizon is set
[[nodiscard]] CoalitionMap find_coalitions(const CoordinationSpec& coordination, std::size_t agents,
                                           const CellSet& invariant,
                                           const std::vector<const DelayLayers*>& layers, ThreadTeam& team);

}  // namespace coordreq

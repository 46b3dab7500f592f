#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "answers/step_codes.hpp"
#include "base/thread_team.hpp"
#include "engine/level_map.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

class CellSet;
class Projections;
class RowEngine;
class RowHull;

/// Cells of Z_F from which a run leaves through a `safe` side, see count_leaving_cells(), and the work of
/// counting them, the same for any number of threads.
struct LeavingCounts {
  std::int64_t cells = 0;
  std::int64_t rows_near = 0;  ///< rows with cells near such a side
  std::int64_t rows_read = 0;  ///< rows of posts read for them
  WaveCounts wave;
};

/// One end of a dimension of the grid of the abstraction.
struct GridSide {
  std::size_t dimension = 0;
  bool above = false;
};

/// The delay layers of one partition, contract "Layers".
struct DelayLayers {
  /// [cells]: 0 outside K, else delay(x) + 1, the number of layers that hold x; LevelMap::kTop where the
  /// delay is not bounded, or not known to be.
  LevelMap layers_of;
  std::vector<std::int64_t> sizes;     ///< |Z_0|, |Z_1|, ..., |Z_F| (or as far as `max_delay` went)
  std::int32_t fixed_point_index = 0;  ///< F; -1 if truncated
  bool truncated =
      false;  ///< `max_delay` came first: the last layer's delays are lower bounds, none is unbounded
  WaveCounts counts;
  std::optional<LeavingCounts> leaving = {};  ///< nothing if such cells are not counted
  /// The first cell, in the order of the spec, with the longest finite delay, or, if none is above 0, with an
  /// unbounded one; nothing if there is neither, or none is known to be the longest. See find_best_cells().
  std::optional<std::int64_t> best_cell = {};
  /// The sides of the domain at which cells of the longest finite delay lie, if all these cells lie at a
  /// side: then a larger domain may hold cells that tolerate more. Sides do not count that are limits of the
  /// system itself (`stop`), that are `safe`, or that belong to discrete states. Empty if there is no finite
  /// delay above 0, or if none is known to be the longest.
  std::vector<GridSide> best_sides = {};

  /// The delay that LevelMap::kTop stands for.
  [[nodiscard]] std::int32_t top_delay() const {
    return truncated ? static_cast<std::int32_t>(sizes.size() - 1) : kUnbounded;
  }
};

/// The levels of Z_0 = K, Z_{k+1} = SIPRE_S(Z_k) (paper, Eq. (6) and Proposition 1), with IND_C given by its
/// projections: DelayLayers::layers_of.
/// An empty layer is a fixed point also where `max_delay` stops at it.
///
/// Partitions that this one refines have delays that are nowhere shorter: their IND_C(x) is a subset of this
/// one's, so that the worst choice is no worse. The wave begins at the least of their levels.
/// @param base Z_0: K, or another set that the choices have to stay in
/// @param projections of C in nonterminal cells
/// @param terminal G of a goal that ends it, which is in every layer; null: there is none
/// @param coarser layers_of for some partitions that this one refines, with the same `max_delay`
[[nodiscard]] LevelMap find_layer_levels(const RowEngine& engine, const RowHull& hull, const CellSet& base,
                                         const Projections& projections,
                                         const std::vector<const LevelMap*>& coarser,
                                         std::optional<std::int64_t> max_delay, const WaveWatch& watch,
                                         ThreadTeam& team, WaveCounts& counts,
                                         const CellSet* terminal = nullptr);

/// The layers of the partition in which all agents are together, without a wave: IND_C = C, and C keeps every
/// cell of K in K, so Z_k = K for every k.
/// @param interned whether equal rows are held once
[[nodiscard]] DelayLayers coordinated_layers(const RowEngine& engine, const CellSet& invariant,
                                             std::optional<std::int64_t> max_delay, ThreadTeam& team,
                                             bool interned = false);

/// Fills in the members that follow from the levels; F is that of Eq. (12).
/// @param beside layers without which these are not fixed, those of safety for approach: A_k = A_{k+1} is a
///   fixed point only if Z_k = Z_{k+1}, too; null: there are none
void follow_from_levels(std::optional<std::int64_t> max_delay, ThreadTeam& team, DelayLayers& layers,
                        const DelayLayers* beside = nullptr);

/// The entry of the trigger table (contract) for a cell of delay `delay`: delay - D, how many steps the
/// agents may go on alone before they must start to connect, if a connection takes D steps; kMustBeConnected
/// if they have none. delay(x) is the k with x in T(k) of the paper, Eq. (11); with D = 0 the table is its
/// countdown, Eq. (13). kOutsideSafe, kOutsideInvariant and kUnbounded stay as they are.
/// @pre connection_delay >= 0
[[nodiscard]] std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay);

}  // namespace coordreq

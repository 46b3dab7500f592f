#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "answers/step_codes.hpp"
#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "engine/level_map.hpp"
#include "engine/row_hull.hpp"
#include "engine/tiles.hpp"
#include "engine/wave.hpp"
#include "engine/wave_watch.hpp"
#include "spec/spec_types.hpp"

// How soon a goal can be reached (contract, section 5): the least solution of arrival(x) = 0 in G,
// 1 + min over u in C(x) of max over y in f(x,u) of arrival(y) elsewhere in K.
//
// Arrival is held as *nearness*, kTop - arrival: the farthest cell of a post then has the least level, so
// that the readers of posts, which take minima, and the operators of K serve arrival too. The least solution
// of arrival is the greatest of nearness that can be reached from below, and levels rise to it from G.
// (Arrivals that sink from infinity would need readers that take maxima.)
namespace coordreq {

/// The arrival that a level of nearness stands for. @pre the level is that of a cell in K
template <class Level>
[[nodiscard]] std::int32_t arrival_of(Level nearness) {
  REQUIRES(nearness > 0);
  if (nearness <= 1) return kUnbounded;
  return static_cast<std::int32_t>(LevelRows<Level>::kTop - nearness);
}
/// The arrival of a cell (row-major linear index) in K.
[[nodiscard]] std::int32_t arrival_at(const LevelMap& nearness, std::int64_t cell);

/// The nearness to begin with: kTop in the goal, 1 in K outside it, 0 outside K.
/// @param interned whether equal rows are held once
[[nodiscard]] LevelMap first_nearness(const RowEngine& engine, const CellSet& invariant, const CellSet& goal,
                                      bool interned);

/// Nearness of all cells: 0 outside K, 1 where the goal cannot be forced, kTop in the goal.
/// @param engine of ProgressEngine
/// @param invariant K @param goal G, a part of K
/// @param tiles in which equal work is found; null: it is not looked for
[[nodiscard]] LevelMap find_nearness(const RowEngine& engine, const RowHull& hull, const CellSet& invariant,
                                     const CellSet& goal, Synthesis synthesis, const WaveWatch& watch,
                                     ThreadTeam& team, WaveCounts& counts, const Tiles* tiles = nullptr);

/// W: the cells from which the goal can be forced.
[[nodiscard]] CellSet winning_cells(const LevelMap& nearness, ThreadTeam& team);

/// The greatest finite arrival; nothing if no cell arrives.
[[nodiscard]] std::optional<std::int32_t> longest_arrival(const LevelMap& nearness, ThreadTeam& team);

}  // namespace coordreq

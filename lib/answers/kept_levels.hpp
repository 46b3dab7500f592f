#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "answers/stage.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_map.hpp"
#include "engine/row_engine.hpp"
#include "engine/wave_watch.hpp"

// Levels and sets of a fixed point, finished or under way, that are kept and resumed.
namespace coordreq {

/// Writes the state of a step to an archive.
using SaveState = std::function<void(Archive& archive, std::span<const NumberRows> state)>;
/// A WaveWatch::step that passes on every step of a fixed point, and keeps its state when it is time.
[[nodiscard]] std::function<void(const WaveStep&)> step_of(const StageWork& work, const RowEngine& engine,
                                                           const SaveState& save);

/// Bounds of the levels of a fixed point, to check loaded ones.
struct LevelBounds {
  const CellSet* members = nullptr;  ///< the cells whose levels are not 0
  std::int64_t most = 0;             ///< the greatest level but LevelMap::kTop
};

/// Saves or loads rows of the grid. @param share null: there is one process
void serialise_rows(Archive& archive, const RowShare* share, const NumberRows& rows);
/// Saves levels, or loads saved ones.
void serialise(Archive& archive, const RowEngine& engine, const LevelBounds& bounds, LevelMap& levels);
/// Saves a set, or loads it. @pre the set has the shape of `within`
/// @param within a superset
void serialise(Archive& archive, const RowShare* share, const CellSet& within, CellSet& set);

/// Finds the levels of a stage: takes kept levels if they are finished, else lets `find` go on from kept ones
/// or begin at the start.
/// @param target where the levels are stored; it keeps its address
void find_or_take_levels(const StageWork& work, const RowEngine& engine, const LevelBounds& bounds,
                         LevelMap& target, const std::function<LevelMap(const WaveWatch& watch)>& find);

}  // namespace coordreq

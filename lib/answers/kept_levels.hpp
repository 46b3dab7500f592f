#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "answers/stage.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_map.hpp"
#include "engine/row_engine.hpp"
#include "engine/wave_watch.hpp"

// Levels and sets of a fixed point, finished or under way, that are kept and taken up again.
namespace coordreq {

/// Tells of every step of a fixed point, and keeps its state when it is time.
/// @param save of the state of a step
using SaveState = std::function<void(Archive& archive, std::span<const NumberRows> state)>;
[[nodiscard]] std::function<void(const WaveStep&)> step_of(const StageWork& work, const RowEngine& engine,
                                                           const SaveState& save);

/// What is known of levels beforehand.
struct LevelBounds {
  const CellSet* members = nullptr;  ///< the cells whose levels are not 0
  std::int64_t most = 0;             ///< the greatest level but LevelMap::kTop
};

/// Rows of the grid, which processes may share. @param share null: there is one
void serialise_rows(Archive& archive, const RowShare* share, const NumberRows& rows);
/// Saves levels, or makes those that were saved.
void serialise(Archive& archive, const RowEngine& engine, const LevelBounds& bounds, LevelMap& levels);
/// Saves a set, or loads it to where it is. @pre it has the shape of `within`
/// @param within the set is a part of
void serialise(Archive& archive, const RowShare* share, const CellSet& within, CellSet& set);

/// The levels of a stage: those that are kept if they are the last, else what `find` makes of them, or finds
/// from the start on.
/// @param place where the levels come to stay
void find_or_take_levels(const StageWork& work, const RowEngine& engine, const LevelBounds& bounds,
                         LevelMap& place, const std::function<LevelMap(const WaveWatch& watch)>& find);

}  // namespace coordreq

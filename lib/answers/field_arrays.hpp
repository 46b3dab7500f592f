#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "answers/convention/convention_freedom.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/field.hpp"
#include "answers/last_value_cache.hpp"
#include "engine/level_map.hpp"
#include "model/cell_order.hpp"

// Turns results of the analysis into arrays of the results file. The arrays refer to the arguments, which
// must outlive the writing.
namespace coordreq {

/// uint8 [cells], 1 for members of S: cells of a level above 0.
[[nodiscard]] ResultArray safe_array(const LevelMap& collision_time, const CellOrder& order);
/// uint8 [cells], 1 for members of K: cells that are never lost.
[[nodiscard]] ResultArray invariant_array(const LevelMap& collision_time, const CellOrder& order);

/// Writes kOutsideSafe for the cells of a segment that are not in S. Integer: std::int16_t,
/// std::int32_t.
template <class Integer>
void mark_unsafe(const LevelMap& collision_time, const CellOrder& order, std::uint64_t begin,
                 std::uint64_t count, Integer* out);
/// uint8 [sets, cells], 1 for members.
[[nodiscard]] ResultArray sets_array(const std::vector<CellSet>& sets, const CellOrder& order);

/// The narrowest of int16 and int32 in which all finite values are below its maximum (contract, section 4).
[[nodiscard]] ElementType level_type(std::int64_t greatest_finite);

/// Collision times, the maximum of the type inside K.
[[nodiscard]] ResultArray collision_array(const LevelMap& collision_time, const CellOrder& order,
                                          ElementType type);
/// Delays; -2 outside S, -1 in S but not in K, the maximum where they are not bounded.
[[nodiscard]] ResultArray delay_array(const DelayLayers& layers, const LevelMap& collision_time,
                                      const CellOrder& order, ElementType type);
/// The trigger table of the delays.
[[nodiscard]] ResultArray trigger_array(const DelayLayers& layers, const LevelMap& collision_time,
                                        std::int64_t connection_delay, const CellOrder& order,
                                        ElementType type);

/// float32 [agents, cells]; NaN outside K.
[[nodiscard]] ResultArray freedom_array(const ConventionFreedom& convention, const CellOrder& order);

/// The layers T(0), ..., T(F) of one partition as ascending lists of linear indices, one after the other
/// (contract `/layers/PARTITION`): where each list begins, F + 2 entries; and the lists, uint32 or uint64.
/// The lists of one partition at a time are in memory (LastValueCache).
[[nodiscard]] std::vector<std::uint64_t> layer_starts(const DelayLayers& layers);
using CellsCache = LastValueCache<const DelayLayers*, FillArray>;
[[nodiscard]] ResultArray layer_cells(const DelayLayers& layers, const CellOrder& order,
                                      const std::shared_ptr<CellsCache>& cache);

}  // namespace coordreq

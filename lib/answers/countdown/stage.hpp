#pragma once

#include <cstdint>
#include <functional>

#include "answers/analysis_context.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/kept_levels.hpp"
#include "answers/stage.hpp"

namespace coordreq {

/// The levels of layers that begin with `base` and end with `max_delay`, to check kept ones.
[[nodiscard]] LevelBounds layer_bounds(const AnalysisContext& context, const CellSet& base);

/// The stage of every kind of countdown: takes kept levels, or lets `find` find them; then what follows from
/// them, and a best cell.
/// @param base the first layer @param layers keeps its address
/// @param find from what is kept, or from the start. @param beside see follow_from_levels()
void find_layers(const AnalysisContext& context, const RowEngine& engine, const CellSet& base,
                 const StageWork& work, DelayLayers& layers,
                 const std::function<LevelMap(const WaveWatch& watch, WaveCounts& counts)>& find,
                 const DelayLayers* beside = nullptr);

}  // namespace coordreq

#pragma once

#include "answers/analysis_context.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "base/json.hpp"

namespace coordreq {

/// Finds DelayLayers::best_cell and best_sides. Cost: a pass over the levels, by all threads. Together.
void find_best_cells(const AnalysisContext& context, ThreadTeam& team, DelayLayers& layers);

/// The centre of DelayLayers::best_cell by the names of the states; null if there is none.
[[nodiscard]] Json best_state_json(const AnalysisContext& context, const DelayLayers& layers);

}  // namespace coordreq

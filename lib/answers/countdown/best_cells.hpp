#pragma once

#include <vector>

#include "answers/analysis_context.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "base/json.hpp"

namespace coordreq {

/// One end of a dimension of the grid of the abstraction.
struct GridSide {
  std::size_t dimension = 0;
  bool above = false;
};

/// The sides of the domain at which cells of the longest finite delay lie, if all these cells lie at a side:
/// then a larger domain may hold cells that tolerate more. Sides do not count that are limits of the system
/// itself (`stop`), that are `safe`, or that belong to discrete states. Empty if there is no finite delay
/// above 0, or if none is known to be the longest. Together.
[[nodiscard]] std::vector<GridSide> sides_of_best_cells(const AnalysisContext& context,
                                                        const DelayLayers& layers);

/// Finds DelayLayers::best_cell. Cost: a pass over the levels, by all threads. Together.
void find_best_cell(const AnalysisContext& context, ThreadTeam& team, DelayLayers& layers);

/// The centre of DelayLayers::best_cell by the names of the states; null if there is none.
[[nodiscard]] Json best_state_json(const AnalysisContext& context, const DelayLayers& layers);

}  // namespace coordreq

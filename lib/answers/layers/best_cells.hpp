#pragma once

#include <vector>

#include "answers/ground.hpp"
#include "answers/layers/delay_layers.hpp"

namespace coordreq {

/// One end of a dimension of the grid of the abstraction.
struct GridSide {
  std::size_t dimension = 0;
  bool above = false;
};

/// The sides of the domain at which cells of the longest finite delay lie, if all of them lie at one: then a
/// larger domain may hold cells that tolerate more. Sides that are a limit of the system itself do not count
/// (`stop`), nor those where what leaves is safe, nor those of discrete states. Nothing if there is no finite
/// delay above 0, or none is known to be the longest. Together.
[[nodiscard]] std::vector<GridSide> sides_of_best_cells(const Ground& ground, const DelayLayers& layers);

}  // namespace coordreq

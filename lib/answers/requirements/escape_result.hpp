#pragma once

#include "answers/ground.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/requirements/escape_path.hpp"

namespace coordreq {

/// A way out with what stands for its cells and actions, cells by the numbers of the spec's grid.
/// @param number_stride as in EscapeSets @param layers of the partition; null: membership in K is asked for
[[nodiscard]] ResultPath result_of(const EscapePath& found, const Ground& ground,
                                   const LevelMap& collision_time, const DelayLayers* layers,
                                   const std::vector<std::int64_t>& number_stride);

}  // namespace coordreq

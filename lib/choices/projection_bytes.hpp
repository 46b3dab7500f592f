#pragma once

#include <vector>

#include "engine/engine_sizes.hpp"

namespace coordreq {

/// The most bytes, about, of Projections onto these classes: known before there is an engine.
///
/// As products they are a few boxes a row, and most rows need none; in rows along several dimensions most
/// cells have a label. Else they are one bit a cell for each action of each class (actions that move every
/// cell of a row alike share it). 0 where all agents are together.
[[nodiscard]] double projection_bytes(const EngineSizes& sizes, const std::vector<InputClass>& classes);

}  // namespace coordreq

#pragma once

#include "engine/cell_set.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Where tubes must stay: f(x, u) counts as empty unless the cells of resolved_tube() are in `inside`, or in
/// `beyond` if the tube passes the limit of a state that saturates.
struct TubeSets {
  const CellSet* inside = nullptr;    ///< null: there are no tubes
  const CellSet* beyond = nullptr;    ///< a part of `inside`; null: the same
  const UniformGrid* grid = nullptr;  ///< with the rules for tubes, if those for posts are others; or null
  bool are_known = true;              ///< else the sets are filled later: RowEngine::take_tube_sets()
};

/// True if the tube of `state` with this raw range passes a limit that the sample puts it back on.
[[nodiscard]] inline bool passes_a_limit(IndexRange raw, const GridDimension& state) {
  return (traits(state.below).resets && raw.first < 0) ||
         (traits(state.above).resets && raw.last >= state.count);
}

}  // namespace coordreq

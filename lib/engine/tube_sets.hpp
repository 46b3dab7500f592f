#pragma once

#include "engine/cell_set.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Where tubes must stay: f(x, u) counts as empty unless the cells of resolved_tube() are in `inside`, or in
/// `beyond` if the tube passes the limit of a state that saturates.
struct TubeSets {
  const CellSet* inside = nullptr;    ///< null: there are no tubes
  const CellSet* beyond = nullptr;    ///< a subset of `inside`; null: `inside` itself
  const UniformGrid* grid = nullptr;  ///< with the rules for tubes; null: they are those for posts
  bool are_known = true;              ///< else the sets are filled later: RowEngine::take_tube_sets()
};

/// True if a tube of `state` with this raw range passes a limit to which the state is set back at the sample.
[[nodiscard]] inline bool passes_a_limit(IndexRange raw, const GridDimension& state) {
  return (traits(state.below).resets && raw.first < 0) ||
         (traits(state.above).resets && raw.last >= state.count);
}

}  // namespace coordreq

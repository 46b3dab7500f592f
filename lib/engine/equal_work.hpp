#pragma once

#include "engine/row_symmetry.hpp"
#include "engine/tiles.hpp"

namespace coordreq {

/// Work of an operator on levels that is known to be equal.
struct EqualWork {
  /// Tiles, and [tile] equal numbers where an operator asks the same of the levels, seen from the tiles.
  const Tiles* tiles = nullptr;  ///< null: nobody looks for equal work
  const Tiles::Numbers* numbers = nullptr;
  /// Under which the operator's levels of a row do not change as long as its own do not; null: there is none.
  /// @pre unchecked: of a tile of several rows all are canonical, or none is.
  const RowSymmetry* symmetry = nullptr;

  /// With numbers, those of the tables if there are none yet.
  [[nodiscard]] EqualWork by_tables() const {
    return {tiles, tiles != nullptr && numbers == nullptr ? &tiles->tables() : numbers, symmetry};
  }
};

}  // namespace coordreq

#pragma once

#include "engine/row_symmetry.hpp"
#include "engine/tiles.hpp"

namespace coordreq {

/// Where an operator does the same work on levels: by tables, by contents, by symmetry.
struct EqualWork {
  const Tiles* tiles = nullptr;  ///< null: equal work is not looked for
  /// [tile] Equal numbers where the operator asks the same of the levels, seen from the tiles.
  const Tiles::Numbers* numbers = nullptr;
  /// Under which the operator's levels of a row do not change as long as its own do not; null: there is none.
  /// @pre unchecked: of a tile of several rows all are canonical, or none is.
  const RowSymmetry* symmetry = nullptr;

  /// This object with the numbers of the tables if it has no numbers.
  [[nodiscard]] EqualWork by_tables() const {
    return {tiles, tiles != nullptr && numbers == nullptr ? &tiles->tables() : numbers, symmetry};
  }
};

}  // namespace coordreq

#pragma once

#include "engine/row_mirror.hpp"
#include "engine/tiles.hpp"

namespace coordreq {

/// Work of an operator on levels that is known to be equal.
struct EqualWork {
  /// Tiles, and [tile] equal numbers where an operator asks the same of the levels, seen from the tiles.
  const Tiles* tiles = nullptr;  ///< null: nobody looks for equal work
  const Tiles::Numbers* numbers = nullptr;
  /// Rows of which an operator says the same where levels are the same in all images; null: there are none.
  /// @pre unchecked: all rows of a tile of many are first, or none is.
  const RowMirror* mirror = nullptr;

  /// With numbers, those of the tables if there are none yet.
  [[nodiscard]] EqualWork by_tables() const {
    return {tiles, tiles != nullptr && numbers == nullptr ? &tiles->tables() : numbers, mirror};
  }
};

}  // namespace coordreq

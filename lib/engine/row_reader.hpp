#pragma once

#include <cstdint>
#include <span>

#include "engine/level_rows.hpp"

namespace coordreq {

/// Least levels over boxes of cells, for a whole row at once: for each cell of the row the minimum over the
/// box that slices say. 0 where they are blocked, the greatest level where all has left for good.
///
/// Tables come in two forms, each with a reader of its own: BoxReader for rows that are cut into segments,
/// and SumReader for rows that are added up. PostReader chooses; nobody else asks.
///
/// One object a thread. The levels may change between one enter() and the next, not in between.
template <class Level>
class RowReader {
 public:
  virtual ~RowReader() = default;
  /// Begins with the rows of another unit: forgets the minima that rows of a unit share.
  virtual void enter() = 0;
  /// From now on in other levels, of the same layout.
  virtual void read(const LevelRows<Level>& levels) = 0;
  /// Least levels of the boxes given by the numbers of their slices, one a table. The row may be read up to
  /// the next call; whole blocks, as LevelKernels ask.
  [[nodiscard]] virtual const Level* minimum(std::span<const std::uint32_t> ids) = 0;
};

}  // namespace coordreq

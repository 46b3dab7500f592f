#pragma once

#include <cstdint>
#include <span>

#include "engine/level_rows.hpp"

namespace coordreq {

/// Least levels over boxes of cells, for a whole row at once: for each cell of the row the minimum over the
/// box that its slices give; 0 where a slice is blocked, else the greatest level where the post has left for
/// good.
///
/// Tables come in two forms, each with a reader of its own: BoxReader for rows that are cut into segments,
/// and SumReader for rows that are added up. PostReader chooses between them.
///
/// One object a thread. Levels do not change from one enter() to the next.
template <class Level>
class RowReader {
 public:
  virtual ~RowReader() = default;
  /// Goes to a unit: forgets the minima that the rows of the last one share.
  virtual void enter() = 0;
  /// Reads other levels, of the same layout, from now on.
  virtual void read(const LevelRows<Level>& levels) = 0;
  /// Least levels of the boxes given by the numbers of their slices, one a table. The row may be read up to
  /// the next call; whole blocks, as LevelKernels ask.
  [[nodiscard]] virtual const Level* minimum(std::span<const std::uint32_t> ids) = 0;
};

}  // namespace coordreq

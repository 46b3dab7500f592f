#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "bitset/row_operations.hpp"
#include "safety/row_slices.hpp"

namespace coordreq {

/// A set of cells that posts are tested against, with its rows eroded beforehand by every window that occurs.
///
/// Erosion commutes with the AND over rows, so eroding each row once serves all the posts that pass through
/// it. Only windows of slices that are one shifted segment are kept, and only while they fit into
/// `kMaxBytes`; others are eroded where they are needed.
class RowTarget {
 public:
  static constexpr std::int64_t kMaxBytes = std::int64_t{512} << 20;

  /// REQUIRES: `set` and `last_slices` (those of the last dimension) outlive this object.
  RowTarget(const CellSet& set, const RowSlices& last_slices, const GridDimension& last_dimension,
            ThreadTeam& team);

  [[nodiscard]] const CellSet& set() const { return *set_; }
  /// The set eroded by the window of slice `id` of the last dimension, or null if that one is not kept.
  [[nodiscard]] const CellSet* eroded(std::uint32_t id) const {
    const std::int32_t position = position_[id];
    return position < 0 ? nullptr : &eroded_[static_cast<std::size_t>(position)];
  }
  /// Brings the eroded rows up to date with a row of the set. Different rows may be refreshed at once.
  void refresh(std::int64_t row, RowEroder& eroder);

 private:
  const CellSet* set_;
  RowEnds ends_;
  std::vector<std::int32_t> position_;  ///< [slice id], -1 if not kept
  std::vector<IndexRange> windows_;
  std::vector<CellSet> eroded_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <vector>

#include "engine/level_rows.hpp"

namespace coordreq {

/// The rows that this process owns: each different row once if rows are interned, else all rows.
template <class Level>
class DifferentRows {
 public:
  /// @pre unchecked: `levels` outlives this object and does not change.
  explicit DifferentRows(const LevelRows<Level>& levels)
      : levels_(levels), local_(local_rows(levels.share(), levels.rows())) {
    if (!levels.is_interned()) return;
    for (std::int64_t r = local_.begin; r < local_.end; ++r) {
      const std::size_t slot = levels.slots()[static_cast<std::size_t>(r)];
      if (slot >= rows_of_slot_.size()) rows_of_slot_.resize(slot + 1, 0);
      ++rows_of_slot_[slot];
    }
  }

  /// The numbers 0, ..., size() - 1 are those that for_each() takes.
  [[nodiscard]] std::int64_t size() const {
    return levels_.is_interned() ? static_cast<std::int64_t>(rows_of_slot_.size())
                                 : local_.end - local_.begin;
  }
  /// Calls `visit(cells, count)` with the first cell of a row, and the number of rows equal to it.
  template <class Visit>
  void for_each(ThreadTeam::Range range, const Visit& visit) const {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      if (!levels_.is_interned()) {
        visit(levels_.row(local_.begin + k), std::int64_t{1});
      } else if (const std::uint32_t count = rows_of_slot_[static_cast<std::size_t>(k)]; count > 0) {
        visit(levels_.first_slot() + k * levels_.stride(), std::int64_t{count});
      }
    }
  }

 private:
  const LevelRows<Level>& levels_;
  RowShare::Range local_;
  std::vector<std::uint32_t> rows_of_slot_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/row_engine.hpp"

namespace coordreq {

/// For each row the smallest box that holds the posts of its cells under all inputs: the rows that can matter
/// to it, and a bound for its levels that costs one look instead of one a joint action.
///
/// Blocked posts, and dimensions in which all has left for good, add nothing to the box.
class RowHull {
 public:
  /// REQUIRES: `engine` outlives this object.
  explicit RowHull(const RowEngine& engine);

  /// What the posts of one row have in common.
  struct Box {
    /// In the dimensions across rows, as in ResolvedRange; first > last: no post has a cell there.
    std::vector<IndexRange> ranges;
    /// Offsets in the dimensions along the row.
    std::vector<IndexRange> windows;
    /// Every post is one box of cells inside the domain or its margins, and all are inside this one: what
    /// holds on the box holds on all posts. Else the box only names the rows that can matter.
    bool covers = true;

    void resize(const RowEngine& engine) {
      ranges.resize(engine.across());
      windows.resize(engine.along());
    }
    /// The range or window of a dimension.
    [[nodiscard]] IndexRange& operator[](std::size_t dimension) {
      return dimension < ranges.size() ? ranges[dimension] : windows[dimension - ranges.size()];
    }
  };
  void box(const RowPlace& place, Box& box) const;

 private:
  struct Entry {
    IndexRange range;
    bool covers = true;
  };
  /// What some of the posts have in common in the dimension of one table: those at base + offset, for all
  /// offsets.
  /// @param reader of the table if it is summed, else null
  [[nodiscard]] Entry entry(std::size_t table, std::int64_t base, std::span<const std::int64_t> offsets,
                            SumRows::Reader* reader) const;
  [[nodiscard]] Entry entry_of_slices(std::size_t table, std::int64_t base,
                                      std::span<const std::int64_t> offsets) const;
  [[nodiscard]] Entry entry_of_sums(std::size_t table, std::int64_t base,
                                    std::span<const std::int64_t> offsets, SumRows::Reader& reader) const;

  const RowEngine* engine_;
  std::vector<std::vector<Entry>> entries_;  ///< [table][row choice]
};

}  // namespace coordreq

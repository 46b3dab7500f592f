#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

// Where rows lie: one row, and a box of rows.
namespace coordreq {

/// A row of the grid and where it lies.
struct RowPlace {
  std::int64_t row = 0;
  std::vector<std::int64_t> index;  ///< in the dimensions across rows

  RowPlace(const UniformGrid& grid, std::int64_t number) : row(number) {
    for (std::size_t i = 0; i < grid.across(); ++i) {
      index.push_back(grid.index(number * grid.row_length(), i));
    }
  }

  /// To the next row, in the order of their numbers.
  void advance(const UniformGrid& grid) {
    ++row;
    for (std::size_t i = index.size(); i-- > 0;) {
      if (++index[i] < grid[i].count) return;
      index[i] = 0;
    }
  }

  /// Sum of index times stride.
  [[nodiscard]] std::int64_t offset(const std::vector<std::int64_t>& stride) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < index.size(); ++i) sum += index[i] * stride[i];
    return sum;
  }
};

/// A box of cells that a row can lead to: rows, and what of each.
struct RowBox {
  /// In the dimensions across rows, as in ResolvedRange; first > last: no post has a cell there.
  std::vector<IndexRange> ranges;
  /// Offsets in the dimensions along the row.
  std::vector<IndexRange> windows;
  /// Every post is one box of cells inside the domain or its margins, and all are inside this one: what holds
  /// on the box holds on all posts. Else the box only names the rows that can matter.
  bool covers = true;

  void resize(const UniformGrid& grid) {
    ranges.resize(grid.across());
    windows.resize(grid.size() - grid.across());
  }
  /// The range or window of a dimension.
  [[nodiscard]] IndexRange& operator[](std::size_t dimension) {
    return dimension < ranges.size() ? ranges[dimension] : windows[dimension - ranges.size()];
  }
};

/// Calls `visit(row number)` for a box of rows: `ranges` in the dimensions from `first` on, as in
/// ResolvedRange, index 0 in those it does not name. On a ring indices beyond the last begin anew.
/// @param counter scratch memory
template <class Visit>
void for_each_row(const UniformGrid& grid, std::size_t first, std::span<const IndexRange> ranges,
                  std::vector<std::int64_t>& counter, const Visit& visit) {
  const std::size_t size = ranges.size();
  counter.resize(size);
  std::int64_t row = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (ranges[i].first > ranges[i].last) return;
    counter[i] = ranges[i].first;
    row += counter[i] * grid.row_stride(first + i);
  }
  for (;;) {
    visit(row);
    std::size_t i = size;
    for (;;) {
      if (i == 0) return;
      --i;
      const std::int64_t stride = grid.row_stride(first + i);
      const std::int64_t count = grid[first + i].count;
      if (++counter[i] <= ranges[i].last) {
        row += counter[i] == count ? stride * (1 - count) : stride;
        break;
      }
      const std::int64_t last = ranges[i].last < count ? ranges[i].last : ranges[i].last - count;
      row -= (last - ranges[i].first) * stride;
      counter[i] = ranges[i].first;
    }
  }
}

}  // namespace coordreq

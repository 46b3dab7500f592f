#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/requires.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

// Where rows lie: one row, and a box of rows.
namespace coordreq {

/// A row of the grid and where it lies.
struct RowPosition {
  std::int64_t row = 0;
  std::vector<std::int64_t> index;  ///< in the dimensions across rows

  RowPosition(const UniformGrid& grid, std::int64_t number) : row(number), index(grid.across()) {
    for (std::size_t i = index.size(); i-- > 0; number /= grid[i].count) index[i] = number % grid[i].count;
  }

  /// To the next row, in the order of their numbers.
  void advance(const UniformGrid& grid) {
    ++row;
    for (std::size_t i = index.size(); i-- > 0;) {
      if (++index[i] < grid[i].count) return;
      index[i] = 0;
    }
  }

  /// To the first row of the next, or the last, choice of the first `dimensions` indices.
  /// @pre this is the first row of one. @pre unchecked: there is such a choice
  void step(const UniformGrid& grid, std::size_t dimensions, bool backwards) {
    REQUIRES(
        std::ranges::none_of(std::span(index).subspan(dimensions), [](std::int64_t i) { return i != 0; }));
    row += backwards ? -grid.row_stride(dimensions - 1) : grid.row_stride(dimensions - 1);
    for (std::size_t i = dimensions; i-- > 0;) {
      const std::int64_t last = grid[i].count - 1;
      if (index[i] != (backwards ? 0 : last)) {
        index[i] += backwards ? -1 : 1;
        return;
      }
      index[i] = backwards ? last : 0;
    }
  }

  /// Sum of index times stride.
  [[nodiscard]] std::int64_t offset(const std::vector<std::int64_t>& stride) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < index.size(); ++i) sum += index[i] * stride[i];
    return sum;
  }
};

/// A box of cells that a row can lead to: a range of rows in each dimension across them, and windows along.
struct RowBox {
  /// In the dimensions across rows, as in ResolvedRange; first > last: no post has a cell there.
  std::vector<IndexRange> ranges;
  /// Offsets in the dimensions along the row.
  std::vector<IndexRange> windows;

  void resize(const UniformGrid& grid) {
    ranges.resize(grid.across());
    windows.resize(grid.size() - grid.across());
  }
  /// The range or window of a dimension.
  [[nodiscard]] IndexRange& operator[](std::size_t dimension) {
    return dimension < ranges.size() ? ranges[dimension] : windows[dimension - ranges.size()];
  }
};

/// Whether `test(sum of index times stride)` is true for some indices of a box; stops at the first. `ranges`
/// as in ResolvedRange: on a ring indices beyond the last begin anew.
/// @param count, stride of the i-th of the ranges
/// @param counter scratch memory
template <class Count, class Stride, class Test>
bool any_in_box(std::span<const IndexRange> ranges, const Count& count, const Stride& stride,
                std::vector<std::int64_t>& counter, const Test& test) {
  if (ranges.empty()) return test(std::int64_t{0});
  const std::size_t last = ranges.size() - 1;
  const IndexRange run = ranges[last];
  if (run.first > run.last) return false;
  counter.resize(last);
  std::int64_t row = 0;
  for (std::size_t i = 0; i < last; ++i) {
    if (ranges[i].first > ranges[i].last) return false;
    counter[i] = ranges[i].first;
    row += counter[i] * stride(i);
  }
  const std::int64_t run_stride = stride(last), run_count = count(last);
  const std::int64_t end = std::min<std::int64_t>(run_count, std::int64_t{run.last} + 1);
  for (;;) {
    for (std::int64_t k = run.first; k < end; ++k) {
      if (test(row + k * run_stride)) return true;
    }
    for (std::int64_t k = run_count; k <= run.last; ++k) {
      if (test(row + (k - run_count) * run_stride)) return true;
    }
    std::size_t i = last;
    for (;;) {
      if (i == 0) return false;
      --i;
      const std::int64_t stride_of_i = stride(i), count_of_i = count(i);
      if (++counter[i] <= ranges[i].last) {
        row += counter[i] == count_of_i ? stride_of_i * (1 - count_of_i) : stride_of_i;
        break;
      }
      const std::int64_t back = ranges[i].last < count_of_i ? ranges[i].last : ranges[i].last - count_of_i;
      row -= (back - ranges[i].first) * stride_of_i;
      counter[i] = ranges[i].first;
    }
  }
}

/// Whether `test(row number)` is true for some row of a box; stops at the first. `ranges` are of the
/// dimensions from `first` on; in the dimensions before, the index is 0.
template <class Test>
bool any_row(const UniformGrid& grid, std::size_t first, std::span<const IndexRange> ranges,
             std::vector<std::int64_t>& counter, const Test& test) {
  return any_in_box(
      ranges, [&](std::size_t i) { return std::int64_t{grid[first + i].count}; },
      [&](std::size_t i) { return grid.row_stride(first + i); }, counter, test);
}

/// Calls `visit(row number)` for all rows of a box.
template <class Visit>
void for_each_row(const UniformGrid& grid, std::size_t first, std::span<const IndexRange> ranges,
                  std::vector<std::int64_t>& counter, const Visit& visit) {
  static_cast<void>(any_row(grid, first, ranges, counter, [&](std::int64_t row) {
    visit(row);
    return false;
  }));
}

/// Makes a list of `content(row number)` for all rows of a box.
template <class Content, class Make>
void list_rows(const UniformGrid& grid, std::size_t first, std::span<const IndexRange> ranges,
               std::vector<std::int64_t>& counter, std::vector<Content>& list, const Make& content) {
  std::size_t size = 1;
  for (const IndexRange& range : ranges)
    size *= static_cast<std::size_t>(std::max(0, range.last - range.first + 1));
  list.resize(size);
  auto next = list.begin();
  for_each_row(grid, first, ranges, counter, [&](std::int64_t row) { *next++ = content(row); });
}

}  // namespace coordreq

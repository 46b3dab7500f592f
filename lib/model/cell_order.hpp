#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/uniform_grid.hpp"

namespace coordreq {

/// Where the cells of the spec's grid lie in the engine's, which may hold the states in another order.
///
/// Row-major linear indices of the spec's grid are what users see; rows and columns are the engine's.
class CellOrder {
 public:
  explicit CellOrder(const UniformGrid& grid) : row_length_(grid.row_length()) {
    for (std::size_t state = 0; state < grid.size(); ++state) {
      const std::size_t p = grid.dimension_of(state);
      counts_.push_back(grid[p].count);
      const bool is_along = p >= grid.across();
      row_step_.push_back(is_along ? 0 : grid.row_stride(p));
      column_step_.push_back(is_along ? grid.stride(p) : 0);
    }
  }

  /// Cells that follow one another in the spec's grid: from (row, column) on, a step apart.
  struct Run {
    std::int64_t row = 0;
    std::int64_t column = 0;
    std::int64_t row_step = 0;
    std::int64_t column_step = 0;
    std::int64_t count = 0;
    std::int64_t offset = 0;  ///< of the first cell from the beginning of the visited cells
  };

  /// Position of the first cell of a run in the engine's grid, row-major, and from one of its cells to the
  /// next.
  [[nodiscard]] std::int64_t position(const Run& run) const { return run.row * row_length_ + run.column; }
  [[nodiscard]] std::int64_t step(const Run& run) const {
    return run.row_step * row_length_ + run.column_step;
  }

  /// Number of cells.
  [[nodiscard]] std::int64_t cells() const {
    std::int64_t product = 1;
    for (const std::int64_t count : counts_) product *= count;
    return product;
  }

  /// Visits the cells [begin, begin + count) of the spec's grid, in order.
  template <class Visit>
  void for_each_run(std::int64_t begin, std::int64_t count, const Visit& visit) const {
    const std::size_t last = counts_.size() - 1;
    std::vector<std::int64_t> index(counts_.size());
    std::int64_t rest = begin;
    for (std::size_t i = counts_.size(); i-- > 0;) {
      index[i] = rest % counts_[i];
      rest /= counts_[i];
    }
    for (std::int64_t offset = 0; offset < count;) {
      Run run{.row_step = row_step_[last], .column_step = column_step_[last], .offset = offset};
      for (std::size_t i = 0; i < index.size(); ++i) {
        run.row += index[i] * row_step_[i];
        run.column += index[i] * column_step_[i];
      }
      run.count = std::min(counts_[last] - index[last], count - offset);
      visit(run);
      offset += run.count;
      index[last] = 0;
      for (std::size_t i = last; i-- > 0;) {
        if (++index[i] < counts_[i]) break;
        index[i] = 0;
      }
    }
  }

 private:
  std::int64_t row_length_;
  std::vector<std::int64_t> counts_;
  std::vector<std::int64_t> row_step_;
  std::vector<std::int64_t> column_step_;
};

}  // namespace coordreq

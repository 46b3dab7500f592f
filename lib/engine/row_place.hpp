#pragma once

#include <cstdint>
#include <vector>

#include "model/uniform_grid.hpp"

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

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Where a table keeps the row along the last dimension for each choice of the other states and of the inputs
/// that it depends on. Equal positions mean that it depends on nothing that differs.
struct RowPositions {
  const UniformGrid* grid = nullptr;
  const InputSpace* input_space = nullptr;
  std::vector<std::int32_t> inputs;        ///< in use, ascending
  std::vector<std::int64_t> state_stride;  ///< by dimension: what one index adds; 0 where not in use
  std::vector<std::int64_t> input_stride;  ///< the same by input
  std::int64_t before = 0;                 ///< positions in front of those that there are

  /// Position of grid row `row` under joint input `u` (any u if no input is in use).
  [[nodiscard]] std::int64_t of(std::int64_t row, std::int64_t u) const {
    std::int64_t position = -before;
    for (std::size_t i = 0; i + 1 < grid->size(); ++i) {
      if (state_stride[i] != 0) position += grid->index(row * grid->row_length(), i) * state_stride[i];
    }
    for (const std::int32_t i : inputs) {
      const auto input = static_cast<std::size_t>(i);
      position += input_space->index(u, input) * input_stride[input];
    }
    return position;
  }
};

}  // namespace coordreq

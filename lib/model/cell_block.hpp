#pragma once

#include <cstdint>
#include <vector>

#include "model/uniform_grid.hpp"

namespace coordreq {

/// Number of cells that are read at a time by code that goes through a whole array.
inline constexpr std::int64_t kBlockCells = 1 << 20;

/// A box of cells: the grid indices first[i], ..., first[i] + count[i] - 1 of each dimension i. Arrays of
/// its cells are row-major, the last dimension fastest.
struct CellBlock {
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> count;
  /// Number of cells.
  [[nodiscard]] std::int64_t cells() const;
};

[[nodiscard]] CellBlock all_cells(const UniformGrid& grid);
/// @pre 0 <= cell < grid.cells()
[[nodiscard]] CellBlock one_cell(const UniformGrid& grid, std::int64_t cell);

/// The cells with linear indices begin, ..., end - 1 as at most 2 * grid.size() - 1 blocks, which one after
/// the other hold them in that order. @pre 0 <= begin <= end <= grid.cells()
[[nodiscard]] std::vector<CellBlock> blocks_of_run(const UniformGrid& grid, std::int64_t begin,
                                                   std::int64_t end);

}  // namespace coordreq

#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "results/results_reader.hpp"

namespace coordreq {

/// A number for each cell: steps, or a place in a list; -3 to -1 are flags, kUnbounded is
/// infinity.
using ReadCells = std::function<std::vector<std::int32_t>(const CellBlock&)>;

/// Calls `visit(block, values)` for all cells in row-major order, about a million at a time.
template <class Visit>
void for_each_part(const UniformGrid& grid, const ReadCells& read, const Visit& visit) {
  for (std::int64_t begin = 0; begin < grid.cells(); begin += kPartCells) {
    const std::int64_t end = std::min(begin + kPartCells, grid.cells());
    for (const CellBlock& block : blocks_of_stretch(grid, begin, end)) visit(block, read(block));
  }
}

/// The first cell with the largest finite value of at least 0; if there is none the first with an infinite
/// one; else -1.
[[nodiscard]] std::int64_t first_largest(const UniformGrid& grid, const ReadCells& read);

}  // namespace coordreq

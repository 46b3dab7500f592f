#include "model/cell_block.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {

std::int64_t CellBlock::cells() const {
  std::int64_t product = 1;
  for (const std::int64_t length : count) product *= length;
  return product;
}

CellBlock all_cells(const UniformGrid& grid) {
  CellBlock block;
  for (const GridDimension& dimension : grid.dimensions()) {
    block.first.push_back(0);
    block.count.push_back(dimension.count);
  }
  return block;
}

CellBlock one_cell(const UniformGrid& grid, std::int64_t cell) {
  REQUIRES(0 <= cell && cell < grid.cells());
  CellBlock block;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    block.first.push_back(grid.index(cell, i));
    block.count.push_back(1);
  }
  return block;
}

std::vector<CellBlock> blocks_of_run(const UniformGrid& grid, std::int64_t begin, std::int64_t end) {
  REQUIRES(0 <= begin && begin <= end && end <= grid.cells());
  std::vector<CellBlock> blocks;
  while (begin < end) {
    // The slowest dimension along which a whole step fits; those after it are taken in full.
    std::size_t i = 0;
    while (begin % grid.stride(i) != 0 || end - begin < grid.stride(i)) ++i;
    CellBlock& block = blocks.emplace_back(one_cell(grid, begin));
    block.count[i] = std::min(grid[i].count - block.first[i], (end - begin) / grid.stride(i));
    for (std::size_t j = i + 1; j < grid.size(); ++j) block.count[j] = grid[j].count;
    begin += block.cells();
  }
  return blocks;
}

}  // namespace coordreq

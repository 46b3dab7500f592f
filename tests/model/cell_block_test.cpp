#include "model/cell_block.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

UniformGrid grid_of(const std::vector<std::int64_t>& counts) {
  std::vector<GridDimension> dimensions;
  for (const std::int64_t count : counts) dimensions.push_back({.name = "x", .step = 1, .count = count});
  return UniformGrid(dimensions);
}

/// Linear indices of the cells of a block, in its order.
void append_cells(const UniformGrid& grid, const CellBlock& block, std::vector<std::int64_t>& cells) {
  for (std::int64_t position = 0; position < block.cells(); ++position) {
    std::int64_t rest = position;
    std::int64_t cell = 0;
    for (std::size_t i = grid.size(); i-- > 0;) {
      cell += (block.first[i] + rest % block.count[i]) * grid.stride(i);
      rest /= block.count[i];
    }
    cells.push_back(cell);
  }
}

TEST(CellBlock, EveryStretchIsItsCellsInOrderInFewBlocks) {
  for (const std::vector<std::int64_t>& counts :
       {std::vector<std::int64_t>{7}, {3, 4}, {2, 3, 4}, {1, 3, 1, 2}}) {
    const UniformGrid grid = grid_of(counts);
    for (std::int64_t begin = 0; begin <= grid.cells(); ++begin) {
      for (std::int64_t end = begin; end <= grid.cells(); ++end) {
        const std::vector<CellBlock> blocks = blocks_of_run(grid, begin, end);
        EXPECT_LE(blocks.size(), 2 * grid.size() - 1);
        std::vector<std::int64_t> cells;
        for (const CellBlock& block : blocks) append_cells(grid, block, cells);
        ASSERT_EQ(static_cast<std::int64_t>(cells.size()), end - begin);
        for (std::int64_t x = begin; x < end; ++x) ASSERT_EQ(cells[static_cast<std::size_t>(x - begin)], x);
      }
    }
  }
}

TEST(CellBlock, AllCellsAndOneCell) {
  const UniformGrid grid = grid_of({2, 3, 4});
  EXPECT_EQ(all_cells(grid).cells(), 24);
  const CellBlock one = one_cell(grid, 17);
  EXPECT_EQ(one.cells(), 1);
  EXPECT_EQ(one.first, (std::vector<std::int64_t>{1, 1, 1}));
}

}  // namespace
}  // namespace coordreq

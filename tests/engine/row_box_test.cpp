#include "engine/row_box.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

UniformGrid grid_of(const std::vector<std::int64_t>& counts) {
  std::vector<GridDimension> dimensions;
  for (const std::int64_t count : counts) {
    dimensions.push_back({.name = "x",
                          .first = 0,
                          .step = 1,
                          .count = count,
                          .below = Outside::unsafe,
                          .above = Outside::unsafe,
                          .lower = 0,
                          .upper = Rational(static_cast<long>(count))});
  }
  return UniformGrid(dimensions);
}

TEST(RowPosition, StepsToTheNextAndTheLastBlockOfRows) {
  const UniformGrid grid = grid_of({3, 2, 4, 5});
  for (std::size_t dimensions = 1; dimensions <= grid.across(); ++dimensions) {
    const std::int64_t rows = grid.row_stride(dimensions - 1);
    for (std::int64_t row = 0; row + rows < grid.rows(); row += rows) {
      RowPosition position(grid, row);
      position.step(grid, dimensions, false);
      EXPECT_EQ(position.row, row + rows);
      EXPECT_EQ(position.index, RowPosition(grid, row + rows).index);
      position.step(grid, dimensions, true);
      EXPECT_EQ(position.row, row);
      EXPECT_EQ(position.index, RowPosition(grid, row).index);
    }
  }
}

TEST(RowBox, PlacesOfABoxAreCountedWithAnyStrides) {
  const std::vector<IndexRange> ranges{{1, 2},
                                       {3, 5}};  // the second range goes on at the other end of a ring of 4
  std::vector<std::int64_t> counter, found;
  const bool any = any_in_box(
      ranges, [](std::size_t i) { return std::int64_t{i == 0 ? 3 : 4}; },
      [](std::size_t i) { return std::int64_t{i == 0 ? 10 : 2}; }, counter,
      [&](std::int64_t position) {
        found.push_back(position);
        return false;
      });
  EXPECT_FALSE(any);
  EXPECT_EQ(found, (std::vector<std::int64_t>{16, 10, 12, 26, 20, 22}));
}

}  // namespace
}  // namespace coordreq

#include "export/report_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

using Indices = std::vector<std::int64_t>;

UniformGrid grid_of(const Indices& counts, Outside below = Outside::unsafe) {
  std::vector<GridDimension> dimensions;
  for (const std::int64_t count : counts) {
    GridDimension dimension;
    dimension.name = "x" + std::to_string(dimensions.size());
    dimension.first = 0;
    dimension.step = 1;
    dimension.count = count;
    dimension.below = dimension.above = below;
    dimensions.push_back(dimension);
  }
  return UniformGrid(dimensions);
}

TEST(ChooseCells, TakesAllIfTheyFit) {
  const auto sets = choose_cells(grid_of({2, 3}), 6, {});
  ASSERT_EQ(sets.size(), 1);
  EXPECT_FALSE(sets[0].shows.has_value());
  EXPECT_EQ(sets[0].indices, (std::vector<Indices>{{0, 1}, {0, 1, 2}}));
  EXPECT_EQ(sets[0].count(), 6);
}

TEST(ChooseCells, HasASetForEveryTwoDimensionsElse) {
  const auto sets = choose_cells(grid_of({4, 5, 31}), 3 * 60, {});
  ASSERT_EQ(sets.size(), 3);
  EXPECT_EQ(sets[0].shows, (std::pair<std::size_t, std::size_t>(0, 1)));
  EXPECT_EQ(sets[0].indices, (std::vector<Indices>{{0, 1, 2, 3}, {0, 1, 2, 3, 4}, {0, 15, 30}}));
  EXPECT_EQ(sets[2].shows, (std::pair<std::size_t, std::size_t>(1, 2)));
  EXPECT_EQ(sets[2].indices[0], (Indices{2}));
}

TEST(ChooseCells, PinsReplaceTheNearest) {
  const auto sets = choose_cells(grid_of({4, 5, 31}), 3 * 60, {{3, 0, 7}, {0, 0, 7}, {1, 4, 29}});
  EXPECT_EQ(sets[0].indices[2], (Indices{7, 15, 29}));
  EXPECT_EQ(sets[2].indices[0], (Indices{3}));  // the first pin
}

TEST(ChooseCells, EndsOfAPeriodicDimensionAreNeighbours) {
  const auto sets = choose_cells(grid_of({4, 5, 30}, Outside::periodic), 3 * 60, {});
  EXPECT_EQ(sets[0].indices[2], (Indices{0, 10, 20}));
}

TEST(ChooseCells, ThinsPicturesThatDoNotFit) {
  const auto sets = choose_cells(grid_of({100, 100}), 25, {{99, 99}});
  ASSERT_EQ(sets.size(), 1);
  EXPECT_EQ(sets[0].indices, (std::vector<Indices>(2, {0, 25, 50, 74, 99})));
}

TEST(ChooseCells, OneDimensionIsAStrip) {
  const auto sets = choose_cells(grid_of({100}), 3, {});
  ASSERT_EQ(sets.size(), 1);
  EXPECT_EQ(sets[0].shows, (std::pair<std::size_t, std::size_t>(0, 0)));
  EXPECT_EQ(sets[0].indices, (std::vector<Indices>{{0, 50, 99}}));
}

TEST(ChooseCells, KeepsToItsRoom) {
  const UniformGrid grid = grid_of({7, 40, 3, 90});
  for (std::int64_t most = 1; most < grid.cells(); most = most * 3 + 1) {
    std::int64_t cells = 0;
    for (const ReportCells& set : choose_cells(grid, most, {{6, 39, 0, 1}, {0, 1, 2, 89}})) {
      cells += set.count();
      for (const Indices& indices : set.indices) {
        EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end()));
        EXPECT_EQ(std::adjacent_find(indices.begin(), indices.end()), indices.end());
      }
    }
    EXPECT_LE(cells, std::max<std::int64_t>(most, 6));  // at least a cell for each of the 6 pictures
  }
}

}  // namespace
}  // namespace coordreq

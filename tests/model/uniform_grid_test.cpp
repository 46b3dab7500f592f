#include "model/uniform_grid.hpp"

#include <gtest/gtest.h>

#include "model/input_space.hpp"

namespace coordreq {
namespace {

GridDimension dimension(const char* name, const Rational& first, const Rational& step, std::int64_t count) {
  return {.name = name, .first = first, .step = step, .count = count};
}

TEST(UniformGrid, LastDimensionIsFastest) {
  const UniformGrid grid({dimension("a", 0, 1, 2), dimension("b", 0, 1, 3), dimension("c", 0, 1, 5)});
  EXPECT_EQ(grid.cells(), 30);
  EXPECT_EQ(grid.rows(), 6);
  EXPECT_EQ(grid.row_length(), 5);
  EXPECT_EQ(grid.stride(0), 15);
  EXPECT_EQ(grid.index(15 + 2 * 5 + 4, 0), 1);
  EXPECT_EQ(grid.index(15 + 2 * 5 + 4, 1), 2);
  EXPECT_EQ(grid.index(15 + 2 * 5 + 4, 2), 4);
}

TEST(UniformGrid, RowsOfSeveralDimensionsHaveGaps) {
  const UniformGrid runs({dimension("a", 0, 1, 2), dimension("b", 0, 1, 3), dimension("c", 0, 1, 5)});
  const UniformGrid grid = runs.in_rows({4});
  EXPECT_EQ(grid.in_rows({}).cells(), runs.cells());
  EXPECT_EQ(grid.across(), 1U);
  EXPECT_EQ(grid.points(), 30);
  EXPECT_EQ(grid.row_length(), 27);
  EXPECT_EQ(grid.rows(), 2);
  EXPECT_EQ(grid.cells(), 54);
  EXPECT_EQ(grid.stride(1), 9);
  EXPECT_EQ(grid.index(27 + 2 * 9 + 4, 0), 1);
  EXPECT_EQ(grid.index(27 + 2 * 9 + 4, 1), 2);
  EXPECT_EQ(grid.index(27 + 2 * 9 + 4, 2), 4);
}

TEST(UniformGrid, DimensionsKnowTheirStates) {
  const UniformGrid grid({dimension("a", 0, 1, 2), dimension("b", 0, 1, 3), dimension("c", 0, 1, 5)});
  EXPECT_EQ(grid.state(2), 2U);
  const UniformGrid turned = grid.arranged({2, 0, 1}).in_rows({});
  EXPECT_EQ(turned[0].name, "c");
  EXPECT_EQ(turned.state(0), 2U);
  EXPECT_EQ(turned.dimension_of(0), 1U);
  EXPECT_EQ(turned.row_stride(0), 2);
  EXPECT_EQ(turned.arranged({1, 2, 0}).state(0), 0U);
}

TEST(UniformGrid, PointsAreExact) {
  const GridDimension d = dimension("a", Rational(-1), Rational(1, 10), 21);
  EXPECT_EQ(d.point(10), Rational(0));
  EXPECT_EQ(d.point(13), Rational(3, 10));
  EXPECT_EQ(d.radius(), Rational(1, 20));
}

TEST(UniformGrid, DiscreteCellsArePoints) {
  GridDimension d = dimension("a", 0, 1, 3);
  d.discrete = true;
  EXPECT_EQ(d.radius(), Rational(0));
}

TEST(InputSpace, JointInputsAreRowMajor) {
  const InputSpace space(
      {{"u", {Rational(-1), Rational(0), Rational(1)}}, {"v", {Rational(5), Rational(7)}}});
  EXPECT_EQ(space.count(), 6);
  EXPECT_EQ(space.index(3, 0), 1);
  EXPECT_EQ(space.index(3, 1), 1);
  EXPECT_EQ(space.stride(0), 2);
}

}  // namespace
}  // namespace coordreq

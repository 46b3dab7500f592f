#include "model/locate.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

GridDimension dimension(Outside below, Outside above) {
  // Points 0, 1, 2, 3; cells from -1/2 to 7/2.
  return {
      .name = "x", .first = 0, .step = 1, .count = 4, .below = below, .above = above, .lower = 0, .upper = 3};
}

Location place(const GridDimension& d, const Rational& value) {
  const std::vector<Rational> state = {value};
  return locate(UniformGrid({d}), state);
}

const Rational kHalf = Rational(1) / 2;

TEST(Locate, CellsAreClosedBelowAndOpenAbove) {
  const GridDimension d = dimension(Outside::unsafe, Outside::unsafe);
  EXPECT_EQ(place(d, -kHalf).cell, 0);
  EXPECT_EQ(place(d, 0).cell, 0);
  EXPECT_EQ(place(d, kHalf).cell, 1);
  EXPECT_EQ(place(d, kHalf - Rational(1) / 1000000000).cell, 0);
  EXPECT_EQ(place(d, Rational(3) + Rational(499) / 1000).cell, 3);
}

TEST(Locate, BeyondAnUnsafeSideIsNoCell) {
  const GridDimension d = dimension(Outside::unsafe, Outside::unsafe);
  const Location above = place(d, 3 + kHalf);
  EXPECT_EQ(above.kind, Location::Kind::beyond);
  EXPECT_TRUE(above.above);
  EXPECT_EQ(above.cell, -1);
  const Location below = place(d, -1);
  EXPECT_EQ(below.kind, Location::Kind::beyond);
  EXPECT_FALSE(below.above);
}

TEST(Locate, BeyondASafeSideIsSafeUnlessAnotherSideIsNot) {
  const GridDimension safe_above = dimension(Outside::unsafe, Outside::safe);
  EXPECT_EQ(place(safe_above, 100).kind, Location::Kind::left_safely);
  EXPECT_EQ(place(safe_above, -100).kind, Location::Kind::beyond);
  const UniformGrid both({safe_above, safe_above});
  EXPECT_EQ(locate(both, std::vector<Rational>{100, 2}).kind, Location::Kind::left_safely);
  const Location location = locate(both, std::vector<Rational>{100, -2});
  EXPECT_EQ(location.kind, Location::Kind::beyond);
  EXPECT_EQ(location.dimension, 1U);
}

TEST(Locate, AMeasurementBeyondALimitReadsAsTheBoundaryCellIfAnErrorExplainsIt) {
  for (const Outside rule : {Outside::saturate, Outside::stop}) {
    GridDimension d = dimension(rule, rule);
    EXPECT_EQ(place(d, 4).kind, Location::Kind::beyond);
    d.measurement_error = 1;
    EXPECT_EQ(place(d, 4).cell, 3);
    EXPECT_EQ(place(d, 4 + Rational(1) / 1000).kind, Location::Kind::beyond);
    EXPECT_EQ(place(d, -1).cell, 0);
    EXPECT_EQ(place(d, -1 - Rational(1) / 1000).kind, Location::Kind::beyond);
  }
}

TEST(Locate, APeriodicDimensionWraps) {
  const GridDimension d = {.name = "h",
                           .first = -2,
                           .step = 1,
                           .count = 4,
                           .below = Outside::periodic,
                           .above = Outside::periodic,
                           .lower = -2,
                           .upper = 2};
  EXPECT_EQ(place(d, -2).cell, 0);
  EXPECT_EQ(place(d, 2).cell, 0);
  EXPECT_EQ(place(d, Rational(3) / 2).cell, 0);
  EXPECT_EQ(place(d, Rational(3) / 2 - Rational(1) / 1000).cell, 3);
  EXPECT_EQ(place(d, -3).cell, 3);
  EXPECT_EQ(place(d, Rational("1000000000000000000000000000001")).cell, 3);
}

TEST(Locate, ADiscreteDimensionHasPoints) {
  GridDimension d = dimension(Outside::unsafe, Outside::unsafe);
  d.discrete = true;
  EXPECT_EQ(place(d, 2).cell, 2);
  EXPECT_EQ(place(d, 2 + kHalf).kind, Location::Kind::off_grid);
  EXPECT_EQ(place(d, 3 + kHalf / 2).kind, Location::Kind::off_grid);
  EXPECT_EQ(place(d, 4).kind, Location::Kind::beyond);
}

TEST(Locate, CellsAreNumberedRowMajor) {
  const GridDimension d = dimension(Outside::unsafe, Outside::unsafe);
  const Location location = locate(UniformGrid({d, d}), std::vector<Rational>{2, 3});
  EXPECT_EQ(location.cell, 11);
  EXPECT_EQ(location.index, (std::vector<std::int64_t>{2, 3}));
}

}  // namespace
}  // namespace coordreq

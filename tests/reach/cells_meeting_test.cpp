#include "reach/cells_meeting.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

/// Cells of width 1 around 0, ..., 9.
GridDimension line(const Rational& error) {
  return {.name = "x",
          .first = 0,
          .step = 1,
          .count = 10,
          .below = Outside::unsafe,
          .above = Outside::unsafe,
          .lower = 0,
          .upper = 9,
          .measurement_error = error};
}

TEST(CellsMeeting, ClosedCellsMeetWhatTheyTouch) {
  const Rational face(1, 2);
  EXPECT_EQ(cells_meeting(line(0), Cells::closed, face, face + 1, true), (IndexRange{0, 2}));
  EXPECT_EQ(cells_meeting(line(0), Cells::closed, face + Rational(1, 10), 1, true), (IndexRange{1, 1}));
}

TEST(CellsMeeting, AHalfOpenCellHasItsLowerFaceOnly) {
  const Rational face(1, 2);
  EXPECT_EQ(cells_meeting(line(0), Cells::half_open, face, face + 1, true), (IndexRange{1, 2}));
  EXPECT_EQ(cells_meeting(line(0), Cells::half_open, face, face + 1, false), (IndexRange{1, 1}));
}

TEST(CellsMeeting, WhatIsMeasuredMayBeOffByTheErrorToBothSides) {
  const Interval enclosure{0.625, 1.375};
  EXPECT_EQ(cells_meeting(line(0), Cells::half_open, enclosure), (IndexRange{1, 1}));
  EXPECT_EQ(cells_meeting(line(Rational(1, 4)), Cells::half_open, enclosure), (IndexRange{0, 2}));
}

TEST(CellsMeeting, AShiftHasTheErrorBeforeAndAfter) {
  // [-1/2, 1/2] and 1/4 twice, moved by 1/2: [-1/2, 3/2] touches the cells around -1 and 2.
  EXPECT_EQ(cells_meeting_shifted(line(Rational(1, 4)), Cells::closed, {0.5, 0.5}), (IndexRange{-1, 2}));
  EXPECT_EQ(cells_meeting_shifted(line(0), Cells::closed, {0.25, 0.25}), (IndexRange{0, 1}));
}

TEST(CellsCovering, NeedNoNeighbourWhoseFaceIsTheEnd) {
  const Rational face(1, 2);
  EXPECT_EQ(cells_covering(line(0), face, face + 1), (IndexRange{1, 1}));
  EXPECT_EQ(cells_covering(line(0), face, face + Rational(11, 10)), (IndexRange{1, 2}));
  EXPECT_EQ(cells_covering(line(Rational(1, 4)), face, face + Rational(5, 4)), (IndexRange{1, 1}));
}

}  // namespace
}  // namespace coordreq

#include "model/pieces.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

namespace coordreq {
namespace {

GridDimension plain(std::int64_t count) {
  return {.name = "x", .first = 0, .step = 1, .count = count, .lower = 0, .upper = count - 1};
}

/// [1, 1 + count), points 1, 2, ..., count.
GridDimension ring(std::int64_t count, const Rational& measurement_error = 0) {
  return {.name = "x",
          .first = 1,
          .step = 1,
          .count = count,
          .below = Outside::periodic,
          .above = Outside::periodic,
          .lower = 1,
          .upper = Rational(1 + count),
          .measurement_error = measurement_error};
}

TEST(Pieces, AnOrdinaryCellIsOnePieceWidenedByTheMeasurementError) {
  GridDimension d = plain(5);
  EXPECT_EQ(pieces(d, 0), (std::vector<Piece>{{Rational(-1, 2), Rational(1, 2)}}));
  d.measurement_error = Rational(3, 4);
  EXPECT_EQ(pieces(d, 4), (std::vector<Piece>{{Rational(11, 4), Rational(21, 4)}}));
}

TEST(Pieces, OfARingAnythingIsPossibleBeyondWhatIndicesHold) {
  constexpr std::int64_t kMost = std::int64_t{1} << 62;  // where rationals become whole numbers no farther
  EXPECT_EQ(raw_range(ring(7), kMost, kMost - 1), (IndexRange{0, 6}));
  EXPECT_EQ(raw_range(ring(7), -kMost, -kMost), (IndexRange{0, 6}));
  EXPECT_EQ(raw_range(ring(7), 7 * (kMost / 14), 7 * (kMost / 14) + 1), (IndexRange{0, 1}));
  EXPECT_EQ(raw_range(plain(7), kMost, kMost - 1), (IndexRange{INT32_MAX, INT32_MAX}));
}

TEST(Pieces, NoStateIsBeyondAStopLimit) {
  GridDimension d = plain(5);
  d.below = Outside::stop;
  EXPECT_EQ(pieces(d, 0), (std::vector<Piece>{{0, Rational(1, 2)}}));
  EXPECT_EQ(pieces(d, 4), (std::vector<Piece>{{Rational(7, 2), Rational(9, 2)}}));
  d.above = Outside::stop;
  d.measurement_error = 1;
  EXPECT_EQ(pieces(d, 1), (std::vector<Piece>{{0, Rational(5, 2)}}));
  EXPECT_EQ(pieces(d, 3), (std::vector<Piece>{{Rational(3, 2), 4}}));
  EXPECT_EQ(pieces(d, 4), (std::vector<Piece>{{Rational(5, 2), 4}}));
}

TEST(Pieces, OnlyBoundaryCellsAreStretched) {
  GridDimension d = plain(3);
  d.extension_below = 2;
  d.extension_above = Rational(1, 4);
  EXPECT_EQ(pieces(d, 0), (std::vector<Piece>{{Rational(-5, 2), Rational(1, 2)}}));
  EXPECT_EQ(pieces(d, 1), (std::vector<Piece>{{Rational(1, 2), Rational(3, 2)}}));
  EXPECT_EQ(pieces(d, 2), (std::vector<Piece>{{Rational(3, 2), Rational(11, 4)}}));
}

TEST(Pieces, ADiscreteCellIsItsPoint) {
  GridDimension d = plain(5);
  d.discrete = true;
  EXPECT_EQ(pieces(d, 3), (std::vector<Piece>{{3, 3}}));
  GridDimension r = ring(4);
  r.discrete = true;
  EXPECT_EQ(pieces(r, 0), (std::vector<Piece>{{1, 1}}));
}

TEST(Pieces, TheCellOnTheSeamIsTwo) {
  const GridDimension d = ring(4);
  EXPECT_EQ(pieces(d, 0), (std::vector<Piece>{{Rational(9, 2), 5}, {1, Rational(3, 2)}}));
  EXPECT_EQ(pieces(d, 1), (std::vector<Piece>{{Rational(3, 2), Rational(5, 2)}}));
  EXPECT_EQ(pieces(d, 3), (std::vector<Piece>{{Rational(7, 2), Rational(9, 2)}}));
}

TEST(Pieces, ACellThatEndsOnTheSeamHasTheLowerPointToo) {
  const GridDimension d = ring(4, Rational(1, 2));
  EXPECT_EQ(pieces(d, 3), (std::vector<Piece>{{3, 5}, {1, 1}}));
  EXPECT_EQ(pieces(d, 1), (std::vector<Piece>{{1, 3}}));
}

TEST(Pieces, ACellAsWideAsThePeriodIsAllOfIt) {
  EXPECT_EQ(pieces(ring(1), 0), (std::vector<Piece>{{1, 2}}));
  EXPECT_EQ(pieces(ring(4, Rational(3, 2)), 2), (std::vector<Piece>{{1, 5}}));
  EXPECT_EQ(pieces(ring(4, 100), 2), (std::vector<Piece>{{1, 5}}));
}

TEST(MergeRanges, IsTheHullOffTheRing) {
  EXPECT_EQ(merge_ranges({-3, 1}, {4, 9}, plain(6)), (IndexRange{-3, 9}));
  EXPECT_EQ(merge_ranges({4, 9}, {5, 6}, plain(6)), (IndexRange{4, 9}));
}

TEST(MergeRanges, TakesTheShorterWayRoundAndKeepsThePlaceOfTheFirst) {
  EXPECT_EQ(merge_ranges({8, 9}, {0, 1}, ring(10)), (IndexRange{8, 11}));
  EXPECT_EQ(merge_ranges({0, 1}, {8, 9}, ring(10)), (IndexRange{-2, 1}));
  EXPECT_EQ(merge_ranges({-2, -1}, {20, 21}, ring(10)), (IndexRange{-2, 1}));
  EXPECT_EQ(merge_ranges({0, 5}, {12, 13}, ring(10)), (IndexRange{0, 5}));
  EXPECT_EQ(merge_ranges({0, 0}, {5, 5}, ring(10)), (IndexRange{0, 5}));
  EXPECT_EQ(merge_ranges({0, 5}, {4, 9}, ring(10)), (IndexRange{0, 9}));
}

TEST(MergeRanges, AnIndexThatLostItsPlaceMeansTheWholeRing) {
  constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  EXPECT_EQ(merge_ranges({3, 3}, {kMax, kMax}, ring(10)), (IndexRange{0, 9}));
  EXPECT_EQ(merge_ranges({kMin, kMin}, {3, 3}, ring(10)), (IndexRange{0, 9}));
}

std::vector<bool> members(IndexRange range, std::int64_t count) {
  std::vector<bool> in(static_cast<std::size_t>(count), false);
  for (std::int64_t k = range.first; k <= range.last; ++k) {
    in[static_cast<std::size_t>((k % count + count) % count)] = true;
  }
  return in;
}

TEST(MergeRanges, IsTheShortestArcThatCoversBoth) {
  EXPECT_TRUE(rc::check("merge on a ring", [] {
    const int count = *rc::gen::inRange(1, 12);
    const auto range = [&] {
      const int first = *rc::gen::inRange(-30, 30);
      return IndexRange{first, first + *rc::gen::inRange(0, 8)};
    };
    const IndexRange a = range();
    const IndexRange b = range();
    const IndexRange merged = merge_ranges(a, b, ring(count));
    const auto in_a = members(a, count);
    const auto in_b = members(b, count);
    const auto covers = [&](IndexRange arc) {
      const auto in = members(arc, count);
      for (std::size_t k = 0; k < in.size(); ++k) {
        if ((in_a[k] || in_b[k]) && !in[k]) return false;
      }
      return true;
    };
    RC_ASSERT(covers(merged));
    for (int first = 0; first < count; ++first) {
      for (int last = first; last - first < merged.last - merged.first; ++last) {
        RC_ASSERT(!covers({first, last}));
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq

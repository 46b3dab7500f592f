#include "answers/checking/cell_pieces.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "model/pieces.hpp"

namespace coordreq {
namespace {

GridDimension ring(std::int64_t count, Rational error = 0) {
  GridDimension dimension{.name = "x", .first = 0, .step = 1, .count = count};
  dimension.below = dimension.above = Outside::periodic;
  dimension.lower = 0;
  dimension.upper = Rational(static_cast<long>(count));
  dimension.measurement_error = std::move(error);
  return dimension;
}

bool is(const RationalInterval& piece, const Rational& lower, const Rational& upper) {
  return piece.lower == lower && piece.upper == upper;
}

TEST(CellParts, ACellOnTheSeamHasTwoParts) {
  const auto pieces = pieces_of(ring(10), 0);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_TRUE(is(pieces[0], Rational(19, 2), 10));
  EXPECT_TRUE(is(pieces[1], 0, Rational(1, 2)));
  EXPECT_EQ(pieces_of(ring(10), 3).size(), 1U);
}

TEST(CellParts, ThePointOnTheSeamIsSeenAsTheLowerEnd) {
  const auto ends_there = pieces_of(ring(10, Rational(1, 2)), 9);
  ASSERT_EQ(ends_there.size(), 2U);
  EXPECT_TRUE(is(ends_there[0], 8, 10));
  EXPECT_TRUE(is(ends_there[1], 0, 0));
  const auto begins_there = pieces_of(ring(10, Rational(1, 2)), 1);
  ASSERT_EQ(begins_there.size(), 1U);
  EXPECT_TRUE(is(begins_there[0], 0, 2));
}

TEST(CellParts, ALimitCutsTheCellBesideIt) {
  GridDimension line{.name = "x", .first = 0, .step = 2, .count = 3};
  line.below = Outside::stop;
  EXPECT_TRUE(is(pieces_of(line, 0).front(), 0, 1));
  EXPECT_TRUE(is(pieces_of(line, 2).front(), 3, 5));
}

TEST(CellParts, TheArcThatHoldsBothIsTheShortest) {
  EXPECT_EQ(both_of({8, 9}, {10, 11}, ring(10)), (IndexRange{8, 11}));
  EXPECT_EQ(both_of({0, 1}, {9, 9}, ring(10)), (IndexRange{-1, 1}));
  EXPECT_EQ(both_of({0, 4}, {5, 9}, ring(10)), (IndexRange{0, 9}));
}

/// Indices that are cut to 2^62 may stand in the wrong order.
TEST(CellParts, OnARingIndicesThatAreNotKnownAreAllCells) {
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  const IndexRange all{0, 9};
  for (const auto& [first, last] :
       {std::pair(1 - kFar, -kFar), std::pair(kFar + 1, kFar), std::pair(-kFar, kFar),
        std::pair(-kFar, std::int64_t{3}), std::pair(std::int64_t{3}, kFar)})
    EXPECT_EQ(cut_to_range(ring(10), first, last), all) << first;
}

/// The functions for checks alone agree with those of the analysis.
TEST(CellParts, AreThoseOfTheAnalysis) {
  EXPECT_TRUE(rc::check([] {
    const auto pick = [](int low, int high) { return *rc::gen::inRange(low, high + 1); };
    GridDimension dimension = ring(pick(1, 12), Rational(pick(0, 30)) / 10);
    dimension.first = Rational(pick(-30, 30)) / 10;
    dimension.step = Rational(pick(1, 30)) / 10;
    dimension.discrete = pick(0, 3) == 0;
    dimension.lower = dimension.first;
    dimension.upper = dimension.first + dimension.step * Rational(static_cast<long>(dimension.count));
    if (pick(0, 1) == 0) {
      const Outside sides[] = {Outside::unsafe, Outside::stop, Outside::saturate};
      dimension.below = sides[pick(0, 2)];
      dimension.above = sides[pick(0, 2)];
      dimension.extension_above = pick(0, 2);
    }
    const std::int64_t k = pick(0, static_cast<int>(dimension.count) - 1);
    const std::vector<RationalInterval> ours = pieces_of(dimension, k);
    const std::vector<Piece> theirs = pieces(dimension, k);
    RC_ASSERT(ours.size() == theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i) RC_ASSERT(is(ours[i], theirs[i].lower, theirs[i].upper));
    const auto range = [&] {
      const int first = pick(-40, 40);
      return IndexRange{first, first + pick(0, 14)};
    };
    const IndexRange a = range();
    const IndexRange b = range();
    RC_ASSERT(both_of(a, b, dimension) == merge_ranges(a, b, dimension));
  }));
}

}  // namespace
}  // namespace coordreq

#include "engine/row_slices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

/// One state and one input; the raw ranges given by entry(cell, input value's index).
template <class Entry>
RowSlices slices(Outside edge, std::int64_t count, std::int64_t inputs, const Entry& entry) {
  const GridDimension dimension{.name = "x",
                                .first = 0,
                                .step = 1,
                                .count = count,
                                .below = edge,
                                .above = edge,
                                .lower = 0,
                                .upper = Rational(static_cast<long>(count))};
  std::vector<Rational> values;
  for (long u = 0; u < inputs; ++u) values.emplace_back(u);
  Abstraction abstraction{.grid = UniformGrid({dimension}), .inputs = InputSpace({{"u", values}})};
  TransitionTable& table = abstraction.tables.emplace_back();
  table.states = {0};
  table.inputs = {0};
  lay_out(table, 0, abstraction.grid, abstraction.inputs);
  for (std::int32_t c = 0; c < count; ++c) {
    for (std::int32_t u = 0; u < inputs; ++u) table.entries.push_back(entry(c, u));
  }
  return cut_into_rows(abstraction, abstraction.tables[0], 0, dimension);
}

TEST(RowSlices, OnARingTurnsThatDifferByWholeRoundsAreOneSlice) {
  const RowSlices cut = slices(Outside::periodic, 10, 3, [](std::int32_t c, std::int32_t u) {
    // The same turn, a whole round less, and counted from the seam anew.
    const std::int32_t first = u == 0 ? c + 8 : u == 1 ? c - 12 : (c + 8) % 10;
    return IndexRange{first, first + 1};
  });
  ASSERT_EQ(cut.slices.size(), 1U);
  ASSERT_EQ(cut.slices[0].size(), 1U);
  EXPECT_EQ(cut.slices[0][0], (RowSegment{0, 10, Kind::shifted, {8, 9}}));
}

TEST(RowSlices, OnARingAllCellsAreOneFixedRange) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  const RowSlices cut = slices(Outside::periodic, 10, 2, [](std::int32_t c, std::int32_t u) {
    return u == 0 ? IndexRange{c - 5, c + 4} : IndexRange{kFar, kFar};
  });
  ASSERT_EQ(cut.slices.size(), 1U);
  EXPECT_EQ(cut.slices[0][0], (RowSegment{0, 10, Kind::fixed, {0, 9}}));
}

/// The same where the offset of every cell is entry(input value's index).
template <class Entry>
RowSlices shift_slices(Outside edge, std::int64_t count, std::int64_t inputs, const Entry& entry) {
  const GridDimension dimension{
      .name = "x", .first = 0, .step = 1, .count = count, .below = edge, .above = edge};
  std::vector<Rational> values;
  for (long u = 0; u < inputs; ++u) values.emplace_back(u);
  Abstraction abstraction{.grid = UniformGrid({dimension}), .inputs = InputSpace({{"u", values}})};
  TransitionTable& table = abstraction.tables.emplace_back();
  table.states = {0};
  table.inputs = {0};
  table.shift = true;
  lay_out(table, 0, abstraction.grid, abstraction.inputs);
  for (std::int32_t u = 0; u < inputs; ++u) table.entries.push_back(entry(u));
  return cut_into_rows(abstraction, abstraction.tables[0], 0, abstraction.grid[0]);
}

/// Where cell c can be next by the segment; a blocked one has no range.
ResolvedRange meaning(const RowSegment& segment, std::int32_t c, std::int64_t count, Outside edge) {
  if (segment.kind == Kind::blocked) return {.blocked = true, .inside = {}};
  if (segment.kind == Kind::gone) return {.blocked = false, .inside = {0, -1}};
  if (segment.kind == Kind::fixed) return {.blocked = false, .inside = segment.range};
  return resolve(moved(segment.range, c), count, edge, edge);
}

TEST(RowSlices, ShiftIsOneSegmentWithoutALookAtItsCells) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  const std::vector<IndexRange> offsets = {{-1, 1},  {9, 9},   {-12, -11},     {-20, 3}, {10, 30},
                                           {-3, 12}, {-9, 13}, {-kFar, -kFar}, {0, 0},   {kFar, kFar}};
  for (const Outside edge : {Outside::unsafe, Outside::safe, Outside::saturate, Outside::periodic}) {
    for (const std::int64_t count : {1, 2, 10}) {
      const auto inputs = static_cast<std::int64_t>(offsets.size());
      const RowSlices cut = shift_slices(
          edge, count, inputs, [&](std::int32_t u) { return offsets[static_cast<std::size_t>(u)]; });
      for (std::size_t u = 0; u < offsets.size(); ++u) {
        const std::vector<RowSegment>& slice = cut.slices[cut.ids[u]];
        ASSERT_EQ(slice.size(), 1U);
        for (std::int32_t c = 0; c < count; ++c) {
          const ResolvedRange expected = resolve(moved(offsets[u], c), count, edge, edge);
          const ResolvedRange found = meaning(slice[0], c, count, edge);
          EXPECT_EQ(found.blocked, expected.blocked);
          if (expected.blocked) continue;
          EXPECT_EQ(found.all_left(), expected.all_left());
          if (!expected.all_left()) {
            EXPECT_EQ(found.inside, expected.inside);
          }
        }
      }
    }
  }
}

TEST(RowSlices, ShiftAcrossTheRowsIsAFixedRangeInEach) {
  const auto line = [](const std::string& name) {
    return GridDimension{.name = name,
                         .first = 0,
                         .step = 1,
                         .count = 4,
                         .below = Outside::saturate,
                         .above = Outside::saturate};
  };
  Abstraction abstraction{.grid = UniformGrid({line("y"), line("x")}),
                          .inputs = InputSpace({{"u", {Rational(0), Rational(1)}}})};
  TransitionTable& table = abstraction.tables.emplace_back();
  table.states = {0};
  table.inputs = {0};
  table.shift = true;
  lay_out(table, 0, abstraction.grid, abstraction.inputs);
  table.entries = {{0, 0}, {1, 2}};
  const RowSlices cut = cut_into_rows(abstraction, abstraction.tables[0], 0, abstraction.grid[0]);
  EXPECT_EQ(cut.state_stride, (std::vector<std::int64_t>{2, 0}));
  ASSERT_EQ(cut.ids.size(), 8U);
  for (std::int32_t y = 0; y < 4; ++y) {
    const IndexRange next{std::min(y + 1, 3), std::min(y + 2, 3)};
    const auto id = static_cast<std::size_t>(2 * y);
    EXPECT_EQ(cut.slices[cut.ids[id]], std::vector{(RowSegment{0, 4, Kind::fixed, {y, y}})});
    EXPECT_EQ(cut.slices[cut.ids[id + 1]], std::vector{(RowSegment{0, 4, Kind::fixed, next})});
  }
}

TEST(RowSlices, AShiftThatLeavesFromEveryCellIsGone) {
  for (const std::int32_t offset : {-10, 10}) {
    const RowSlices cut = shift_slices(Outside::safe, 10, 1, [&](std::int32_t) {
      return IndexRange{offset, offset};
    });
    ASSERT_EQ(cut.slices.size(), 1U);
    EXPECT_EQ(cut.slices[0][0].kind, Kind::gone) << offset;
  }
}

TEST(RowSlices, OffTheRingFarIndicesStayApart) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  const RowSlices cut = slices(Outside::unsafe, 10, 2, [](std::int32_t c, std::int32_t u) {
    return u == 0 ? IndexRange{c, c + 1} : IndexRange{kFar, kFar};
  });
  ASSERT_EQ(cut.slices.size(), 2U);
  EXPECT_EQ(cut.slices[0][0], (RowSegment{0, 10, Kind::shifted, {0, 1}}));
  EXPECT_EQ(cut.slices[1][0].kind, Kind::blocked);
}

}  // namespace
}  // namespace coordreq

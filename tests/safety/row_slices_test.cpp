#include "safety/row_slices.hpp"

#include <gtest/gtest.h>

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
  lay_out(table, abstraction.grid, abstraction.inputs);
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

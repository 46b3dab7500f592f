#include "engine/row_operations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace coordreq {
namespace {

TEST(RowBits, SettingRangesAndComparingRows) {
  EXPECT_TRUE(rc::check("set_bits", [] {
    const auto n = *rc::gen::inRange<std::int64_t>(1, 200);
    const auto begin = *rc::gen::inRange<std::int64_t>(0, n + 1);
    const auto end = *rc::gen::inRange<std::int64_t>(begin, n + 1);
    std::vector<Word> row(static_cast<std::size_t>((n + 63) / 64), 0);
    set_bits(row, begin, end);
    std::vector<std::int64_t> found;
    for_each_bit(row, [&](std::int64_t c) { found.push_back(c); });
    std::vector<std::int64_t> expected;
    for (std::int64_t c = begin; c < end; ++c) expected.push_back(c);
    RC_ASSERT(found == expected);
    RC_ASSERT(any_set(row) == (begin < end));
    std::vector<Word> more = row;
    RC_ASSERT(is_subset(row, more));
    if (end < n) {
      set_bits(more, end, n);
      RC_ASSERT(is_subset(row, more));
      RC_ASSERT(!is_subset(more, row));
    }
  }));
}

TEST(CellSet, RowsArePaddedAndCountedRight) {
  CellSet set(3, 65);
  set.set(64);
  set.set(65);
  set.set(194);
  EXPECT_EQ(set.count(), 3);
  EXPECT_EQ(set.row(0)[1], Word{1});
  EXPECT_EQ(set.row(1)[0], Word{1});
  EXPECT_TRUE(set.test(194));
  set.reset(65);
  EXPECT_FALSE(set.test(65));
  EXPECT_EQ(set.cells(), 195);
}

}  // namespace
}  // namespace coordreq

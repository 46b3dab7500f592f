#include "bitset/row_operations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace coordreq {
namespace {

std::vector<Word> pack(const std::vector<bool>& bits) {
  std::vector<Word> words((bits.size() + 63) / 64, 0);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i]) words[i / 64] |= Word{1} << (i % 64);
  }
  return words;
}

bool beyond(Outside rule, bool end) {
  const bool goes_on = rule == Outside::saturate || rule == Outside::stop;
  return rule == Outside::safe || (goes_on && end);
}

std::size_t on_ring(std::int64_t position, std::size_t n) {
  const auto size = static_cast<std::int64_t>(n);
  return static_cast<std::size_t>((position % size + size) % size);
}

/// Erosion by its definition, one bit at a time.
std::vector<bool> eroded_plainly(const std::vector<bool>& row, std::int64_t low, std::int64_t high,
                                 RowEnds ends) {
  const auto n = static_cast<std::int64_t>(row.size());
  std::vector<bool> out;
  for (std::int64_t x = 0; x < n; ++x) {
    bool all = true;
    for (std::int64_t p = x + low; p <= x + high; ++p) {
      const bool bit = ends.below == Outside::periodic ? row[on_ring(p, row.size())]
                       : p < 0                         ? beyond(ends.below, row.front())
                       : p >= n                        ? beyond(ends.above, row.back())
                                                       : row[static_cast<std::size_t>(p)];
      all = all && bit;
    }
    out.push_back(all);
  }
  return out;
}

TEST(RowEroder, EqualsTheDefinitionOnRowsOfEveryLengthAndOffset) {
  EXPECT_TRUE(rc::check("erode", [] {
    const auto n = *rc::gen::inRange<std::size_t>(1, 300);
    const bool dense = *rc::gen::arbitrary<bool>();
    std::vector<bool> row;
    for (std::size_t i = 0; i < n; ++i) row.push_back(*rc::gen::inRange(0, 10) != 0 || !dense);
    const int low = *rc::gen::inRange(-350, 350);
    const int width = *rc::gen::inRange(0, *rc::gen::element(3, 40, 400));
    const auto rule = [] {
      return *rc::gen::element(Outside::unsafe, Outside::safe, Outside::saturate, Outside::stop);
    };
    const bool is_ring = *rc::gen::inRange(0, 3) == 0;
    const RowEnds ends = is_ring ? RowEnds{Outside::periodic, Outside::periodic} : RowEnds{rule(), rule()};
    std::vector<Word> out(pack(row).size());
    RowEroder().erode(pack(row), static_cast<std::int64_t>(n), low, low + width, ends, out);
    RC_ASSERT(out == pack(eroded_plainly(row, low, low + width, ends)));
  }));
}

TEST(RowEroder, ExtremeOffsetsDoNotOverflow) {
  const std::vector<Word> row = pack(std::vector<bool>(70, true));
  std::vector<Word> out(row.size());
  RowEroder().erode(row, 70, INT32_MIN, INT32_MAX, {Outside::saturate, Outside::safe}, out);
  EXPECT_EQ(out, row);
  RowEroder().erode(row, 70, INT32_MAX, INT32_MAX, {Outside::safe, Outside::unsafe}, out);
  EXPECT_EQ(out, pack(std::vector<bool>(70, false)));
}

TEST(RowEroder, OnARingTheWindowGoesOnAtTheOtherEnd) {
  std::vector<bool> bits(130, true);
  bits[129] = false;
  const std::vector<Word> row = pack(bits);
  const RowEnds ring{Outside::periodic, Outside::periodic};
  std::vector<Word> out(row.size());
  RowEroder().erode(row, 130, -1, 1, ring, out);
  bits[128] = bits[0] = false;
  EXPECT_EQ(out, pack(bits));
  RowEroder().erode(row, 130, 390 - 1, 390 + 1, ring, out);
  EXPECT_EQ(out, pack(bits));
  RowEroder().erode(row, 130, -1000, 1000, ring, out);
  EXPECT_EQ(out, pack(std::vector<bool>(130, false)));
}

TEST(RowBits, SettingAndTestingRanges) {
  EXPECT_TRUE(rc::check("set_bits and all_set", [] {
    const auto n = *rc::gen::inRange<std::int64_t>(1, 200);
    const auto begin = *rc::gen::inRange<std::int64_t>(0, n + 1);
    const auto end = *rc::gen::inRange<std::int64_t>(begin, n + 1);
    std::vector<Word> row(static_cast<std::size_t>((n + 63) / 64), 0);
    set_bits(row, begin, end);
    for (std::int64_t i = 0; i < n; ++i) RC_ASSERT(all_set(row, i, i + 1) == (begin <= i && i < end));
    RC_ASSERT(all_set(row, begin, end));
    RC_ASSERT(any_set(row) == (begin < end));
    if (end < n) RC_ASSERT(!all_set(row, begin, end + 1));
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

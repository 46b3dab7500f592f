#include "engine/level_rows.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "engine/different_rows.hpp"

namespace coordreq {
namespace {

using ByteRows = LevelRows<std::uint8_t>;

/// The row 7 8 9 with its margins: two cells before, four after.
std::vector<int> closed(RowEnds ends) {
  ByteRows levels(2, 3, {2, 4}, ends);
  levels.change_row(1, [](std::uint8_t* cells) { std::iota(cells, cells + 3, std::uint8_t{7}); });
  return {levels.row(1) - 2, levels.row(1) + 7};
}

TEST(LevelRows, GoOnBeyondTheirEndsByTheRulesForLeaving) {
  EXPECT_EQ(closed({Outside::unsafe, Outside::safe}), (std::vector<int>{0, 0, 7, 8, 9, 255, 255, 255, 255}));
  EXPECT_EQ(closed({Outside::safe, Outside::unsafe}), (std::vector<int>{255, 255, 7, 8, 9, 0, 0, 0, 0}));
  EXPECT_EQ(closed({Outside::saturate, Outside::stop}), (std::vector<int>{7, 7, 7, 8, 9, 9, 9, 9, 9}));
  EXPECT_EQ(closed({Outside::periodic, Outside::periodic}), (std::vector<int>{8, 9, 7, 8, 9, 7, 8, 9, 7}));
}

TEST(LevelRows, ChangingOneRowLeavesTheOthers) {
  ByteRows levels(3, 5, {3, 3}, {Outside::safe, Outside::safe});
  levels.change_row(1, [](std::uint8_t*) {});
  for (const std::int64_t r : {0, 2}) {
    EXPECT_EQ(std::vector<int>(levels.row(r) - 3, levels.row(r) + 8), std::vector<int>(11, 0));
  }
}

/// Level of cell (i, j) of a row of 3 times 2 cells, or beyond its ends: rule after rule, the slower
/// dimension first, an unsafe end being stronger than any other.
int expected_level(std::int64_t i, std::int64_t j, RowEnds slow, RowEnds fast) {
  bool gone = false;
  const auto bring_in = [&gone](std::int64_t& k, std::int64_t n, RowEnds ends) {
    if (k >= 0 && k < n) return true;
    const Outside rule = k < 0 ? ends.below : ends.above;
    if (rule == Outside::unsafe) return false;
    gone = gone || rule == Outside::safe;
    k = rule == Outside::periodic ? (k % n + n) % n : (k < 0 ? 0 : n - 1);
    return true;
  };
  if (!bring_in(i, 3, slow) || !bring_in(j, 2, fast)) return 0;
  return gone ? 255 : static_cast<int>(10 * i + j + 1);
}

TEST(LevelRows, OfSeveralDimensionsGoOnInEach) {
  const std::vector<RowEnds> all = {{Outside::unsafe, Outside::safe},
                                    {Outside::safe, Outside::unsafe},
                                    {Outside::saturate, Outside::stop},
                                    {Outside::periodic, Outside::periodic}};
  for (const RowEnds slow : all) {
    for (const RowEnds fast : all) {
      // Runs of 2 cells with a gap of 5; one index before and two after in the slower dimension.
      ByteRows levels(2, RowShape{{{3, 7, {1, 2}, slow}, {2, 1, {2, 3}, fast}}});
      ASSERT_EQ(levels.row_length(), 21);
      levels.change_row(1, [](std::uint8_t* cells) {
        for (std::int64_t i = 0; i < 3; ++i) {
          for (std::int64_t j = 0; j < 2; ++j) cells[7 * i + j] = static_cast<std::uint8_t>(10 * i + j + 1);
        }
      });
      const std::uint8_t* const row = levels.row(1);
      for (std::int64_t i = -1; i < 5; ++i) {
        for (std::int64_t j = -2; j < 5; ++j)
          EXPECT_EQ(row[7 * i + j], expected_level(i, j, slow, fast)) << i << ", " << j;
      }
      std::vector<std::uint8_t> lanes(row, row + 21);
      levels.clear_gaps(lanes.data());
      for (std::int64_t lane = 0; lane < 21; ++lane)
        EXPECT_EQ(lanes[static_cast<std::size_t>(lane)], lane % 7 < 2 ? 10 * (lane / 7) + lane % 7 + 1 : 0);
    }
  }
}

TEST(LevelRows, InternedRowsAreHeldOnceAndReadAsOthersAre) {
  const RowShape shape{{{3, 7, {1, 2}, {Outside::safe, Outside::saturate}},
                        {2, 1, {2, 3}, {Outside::periodic, Outside::periodic}}}};
  EXPECT_TRUE(rc::check("interned rows", [&] {
    ByteRows plain(5, shape);
    ByteRows interned(5, shape, true);
    for (std::int64_t r = 0; r < 5; ++r) plain.change_row(r, [](std::uint8_t*) {});
    const int changes = *rc::gen::inRange(0, 30);
    for (int k = 0; k < changes; ++k) {
      const auto r = *rc::gen::inRange<std::int64_t>(0, 5);
      std::vector<std::uint8_t> cells(21 + kLevelBlock, 0);
      shape.for_each_run([&](std::int64_t lane, std::int64_t count) {
        for (std::int64_t c = lane; c < lane + count; ++c)
          cells[static_cast<std::size_t>(c)] = *rc::gen::element<std::uint8_t>(0, 0, 1, 255);
      });
      const auto from = *rc::gen::inRange<std::int64_t>(0, 5);
      if (*rc::gen::inRange(0, 4) == 0) {
        const std::vector<std::uint8_t> other(plain.row(from), plain.row(from) + 21 + kLevelBlock);
        plain.put(r, other.data());
        const bool was_equal = interned.content(from) == interned.content(r);
        RC_ASSERT(interned.copy_row(from, r) != was_equal);
      } else if (*rc::gen::inRange(0, 3) == 0) {
        const auto change = [&](std::uint8_t* row) { row[0] = cells[0]; };
        plain.change_row(r, change);
        interned.change_row(r, change);
      } else {
        plain.put(r, cells.data());
        interned.put(r, cells.data());
      }
      if (k % 7 == 0) interned.renumber();
    }
    const RowMargins margins = plain.margins();
    const DifferentRows<std::uint8_t> different(interned);
    std::int64_t held = 0;
    std::set<const std::uint8_t*> met;
    different.for_each({0, different.size()}, [&](const std::uint8_t* row, std::int64_t rows) {
      held += rows;
      RC_ASSERT(met.insert(row).second);
    });
    RC_ASSERT(held == 5);
    for (std::int64_t r = 0; r < 5; ++r) {
      const std::uint8_t* const a = plain.row(r);
      const std::uint8_t* const b = interned.row(r);
      RC_ASSERT(std::equal(a - margins.before, a + 21 + margins.after, b - margins.before));
      for (std::int64_t other = 0; other < r; ++other) {
        const bool equal = std::equal(a, a + 21, plain.row(other));
        RC_ASSERT((b == interned.row(other)) == equal);
        RC_ASSERT((interned.content(r) == interned.content(other)) == equal);
      }
    }
  }));
}

TEST(LevelRows, ThatWereMadeReadyArePutAsTheyWereWhateverWasPutSince) {
  for (const bool is_taken_again : {false, true}) {
    ByteRows levels(4, RowShape{{{1, 1, {0, 0}, {Outside::safe, Outside::safe}}}}, true);
    const auto put = [&](std::int64_t r, std::uint8_t level) {
      levels.change_row(r, [level](std::uint8_t* cells) { *cells = level; });
    };
    put(0, 5);
    put(1, 6);
    const std::uint32_t slot = levels.slots()[0];
    std::vector<std::uint8_t> five(static_cast<std::size_t>(levels.stride()), 5);
    const ByteRows::Ready ready = levels.make_ready(five.data());
    EXPECT_EQ(ready.slot, slot);
    put(0, 7);  // the slot is free
    if (is_taken_again) put(1, 8);
    EXPECT_EQ(levels.slots()[1] == slot, is_taken_again);
    levels.put_ready(2, five.data(), ready);
    EXPECT_EQ(*levels.row(0), 7);
    EXPECT_EQ(*levels.row(1), is_taken_again ? 8 : 6);
    put(1, 9);
    EXPECT_EQ(*levels.row(2), 5);
  }
}

TEST(LevelRows, PlacedTogetherAreThoseThatOnePutsOneByOne) {
  // Rows change more than once before contents are copied, so that slots become free and are taken again.
  constexpr std::int64_t kRows = 200;
  const RowShape shape{{{3, 1, {2, 4}, {Outside::saturate, Outside::safe}}}};
  EXPECT_TRUE(rc::check("placed rows", [&] {
    ByteRows expected(kRows, shape, true), levels(kRows, shape, true);
    ThreadTeam team(*rc::gen::inRange(1, 4));
    const auto stride = static_cast<std::size_t>(levels.stride());
    const auto width = stride + kLevelBlock;
    for (int batch = 0; batch < 4; ++batch) {
      const auto rows =
          *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(0, kRows));
      std::vector<std::uint8_t> lanes(rows.size() * width, 0);
      std::vector<ByteRows::Ready> ready;
      const auto lanes_of = [&](std::size_t k) { return lanes.data() + k * width; };
      const int contents = *rc::gen::inRange(1, 250);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        lanes_of(k)[2] = static_cast<std::uint8_t>(*rc::gen::inRange(0, contents));
        ready.push_back(levels.make_ready(lanes_of(k)));
      }
      for (std::size_t k = 0; k < rows.size(); ++k) {
        levels.place(rows[k], lanes_of(k), ready[k]);
        expected.put(rows[k], lanes_of(k) + 2);
      }
      levels.fill_placed(&team);
      RC_ASSERT(levels.slots() == expected.slots());
      for (std::int64_t r = 0; r < kRows; ++r)
        RC_ASSERT(std::equal(levels.row(r) - 2, levels.row(r) + 7, expected.row(r) - 2));
    }
  }));
}

TEST(LevelRows, MarkCellsThatLeaveThroughUnsafeEnds) {
  const RowShape shape{{{3, 7, {1, 2}, {Outside::unsafe, Outside::safe}},
                        {2, 1, {2, 3}, {Outside::saturate, Outside::unsafe}}}};
  std::vector<Word> bits(1, 0);
  mark_leaving(shape, 0, {-1, 5}, bits);  // indices below 1 of the slower one, all lanes
  EXPECT_EQ(bits[0], Word{0x7F});
  bits[0] = 0;
  mark_leaving(shape, 1, {-2, 1}, bits);  // the last cell of each run
  EXPECT_EQ(bits[0], Word{1} << 1 | Word{1} << 8 | Word{1} << 15);
}

TEST(LevelRows, PutByThreadsAreThoseThatOnePuts) {
  // More than are worked out at once, and few different ones.
  constexpr std::int64_t kRows = 20'000, kCells = 3;
  const auto fill = [](std::int64_t r, std::uint8_t* cells) {
    for (std::int64_t c = 0; c < kCells; ++c) cells[c] = static_cast<std::uint8_t>((r * r + c) % 7);
  };
  const RowShape shape{{{kCells, 1, {2, 4}, {Outside::saturate, Outside::safe}}}};
  for (const bool is_interned : {false, true}) {
    ByteRows expected(kRows, shape, is_interned);
    for (std::int64_t r = 0; r < kRows; ++r)
      expected.change_row(r, [&](std::uint8_t* cells) { fill(r, cells); });
    for (const int threads : {1, 3}) {
      ByteRows levels(kRows, shape, is_interned);
      ThreadTeam team(threads);
      put_rows(levels, team, fill);
      EXPECT_EQ(levels.slots(), expected.slots());
      for (std::int64_t r = 0; r < kRows; ++r)
        ASSERT_TRUE(std::equal(levels.row(r) - 2, levels.row(r) + 7, expected.row(r) - 2)) << r;
    }
  }
}

}  // namespace
}  // namespace coordreq

#include "bitset/level_rows.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

using Levels = LevelRows<std::uint8_t>;

/// The row 7 8 9 with all it goes on with: two cells before, four after.
std::vector<int> closed(RowEnds ends) {
  Levels levels(2, 3, {2, 4}, ends);
  for (int c = 0; c < 3; ++c) levels.row(1)[c] = static_cast<std::uint8_t>(7 + c);
  levels.close(1);
  return {levels.row(1) - 2, levels.row(1) + 7};
}

TEST(LevelRows, GoOnBeyondTheirEndsByTheRulesForLeaving) {
  EXPECT_EQ(closed({Outside::unsafe, Outside::safe}), (std::vector<int>{0, 0, 7, 8, 9, 255, 255, 255, 255}));
  EXPECT_EQ(closed({Outside::safe, Outside::unsafe}), (std::vector<int>{255, 255, 7, 8, 9, 0, 0, 0, 0}));
  EXPECT_EQ(closed({Outside::saturate, Outside::stop}), (std::vector<int>{7, 7, 7, 8, 9, 9, 9, 9, 9}));
  EXPECT_EQ(closed({Outside::periodic, Outside::periodic}), (std::vector<int>{8, 9, 7, 8, 9, 7, 8, 9, 7}));
}

TEST(LevelRows, ClosingOneRowLeavesTheOthers) {
  Levels levels(3, 5, {3, 3}, {Outside::safe, Outside::safe});
  levels.close(1);
  for (const std::int64_t r : {0, 2}) {
    EXPECT_EQ(std::vector<int>(levels.row(r) - 3, levels.row(r) + 8), std::vector<int>(11, 0));
  }
}

}  // namespace
}  // namespace coordreq

#include "engine/level_map.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

template <class Level>
LevelMap sample(std::int64_t length) {
  LevelRows<Level> rows(3, length, {1, 2}, {Outside::safe, Outside::safe});
  rows.change_row(0, [](Level* row) { row[0] = 1; });
  rows.change_row(1, [&](Level* row) { row[length - 1] = 3; });
  rows.change_row(2, [](Level* row) { row[1] = LevelRows<Level>::kTop; });
  return LevelMap(std::move(rows));
}

TEST(LevelMap, CountsTheCellsOfEachLevelButNotTheMargins) {
  ThreadTeam team(2);
  for (const LevelMap& map :
       {sample<std::uint8_t>(70), sample<std::uint16_t>(70), sample<std::uint32_t>(70)}) {
    const LevelMap::Histogram histogram = map.histogram(team);
    EXPECT_EQ(histogram.finite, (std::vector<std::int64_t>{207, 1, 0, 1}));
    EXPECT_EQ(histogram.top, 1);
    EXPECT_EQ(map.at(0), 1);
    EXPECT_EQ(map.at(139), 3);
    EXPECT_EQ(map.at(141), LevelMap::kTop);
    const CellSet top = map.top_cells(team);
    EXPECT_EQ(top.count(), 1);
    EXPECT_TRUE(top.test(141));
  }
}

TEST(LevelMap, NothingButTopHasNoFiniteLevels) {
  ThreadTeam team(1);
  LevelRows<std::uint8_t> rows(1, 4, {0, 0}, {});
  rows.change_row(0, [](std::uint8_t* row) { std::fill_n(row, 4, LevelRows<std::uint8_t>::kTop); });
  const LevelMap::Histogram histogram = LevelMap(std::move(rows)).histogram(team);
  EXPECT_TRUE(histogram.finite.empty());
  EXPECT_EQ(histogram.top, 4);
}

}  // namespace
}  // namespace coordreq

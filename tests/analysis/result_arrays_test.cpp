#include "analysis/result_arrays.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

constexpr std::int32_t kEnd = DelayLayers::kUnbounded;

TEST(ResultArrays, SmallLevelsAreStoredInSixteenBits) {
  EXPECT_EQ(level_type({-2, 32766, kEnd}, kEnd), ElementType::int16);
  EXPECT_EQ(level_type({-2, 32767, kEnd}, kEnd), ElementType::int32);
  EXPECT_EQ(level_type({kEnd}, kEnd), ElementType::int16);
}

TEST(ResultArrays, UnboundedIsTheLargestValueOfTheType) {
  const std::vector<std::int32_t> levels = {-2, -1, 0, 7, kEnd};
  std::vector<std::int16_t> narrow(4);
  level_array(levels, kEnd, ElementType::int16).fill(1, 4, narrow.data());
  EXPECT_EQ(narrow, (std::vector<std::int16_t>{-1, 0, 7, 32767}));
  std::vector<std::int32_t> wide(5);
  level_array(levels, kEnd, ElementType::int32).fill(0, 5, wide.data());
  EXPECT_EQ(wide, levels);
}

TEST(ResultArrays, TriggersAreDerivedFromDelays) {
  const std::vector<std::int32_t> delays = {-2, -1, 0, 1, 5, kEnd};
  std::vector<std::int16_t> out(6);
  trigger_array(delays, 2, ElementType::int16).fill(0, 6, out.data());
  EXPECT_EQ(out, (std::vector<std::int16_t>{-2, -1, -3, -3, 3, 32767}));
}

TEST(ResultArrays, LayersListTheirCellsInAscendingOrder) {
  DelayLayers layers;
  layers.delay = {1, -2, 0, kEnd, 1, -1, 0};
  layers.sizes = {5, 3, 1};
  const ResultLayers lists = layer_lists(layers);
  EXPECT_EQ(lists.start, (std::vector<std::uint64_t>{0, 2, 4, 5}));
  EXPECT_EQ(lists.cell.type, ElementType::uint32);
  std::vector<std::uint32_t> cells(5);
  lists.cell.fill(0, 5, cells.data());
  EXPECT_EQ(cells, (std::vector<std::uint32_t>{2, 6, 0, 4, 3}));
}

TEST(ResultArrays, MembersAreOnesAcrossRowPadding) {
  CellSet set(2, 3);
  set.set(2);
  set.set(3);
  std::vector<std::uint8_t> out(6);
  membership_array(set).fill(0, 6, out.data());
  EXPECT_EQ(out, (std::vector<std::uint8_t>{0, 0, 1, 1, 0, 0}));
}

}  // namespace
}  // namespace coordreq

#include "model/outside.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coordreq {
namespace {

constexpr auto kUnsafe = Outside::unsafe;
constexpr auto kSafe = Outside::safe;
constexpr auto kSaturate = Outside::saturate;

TEST(Outside, InsideNoRuleMatters) {
  for (const Outside rule : {kUnsafe, kSafe, kSaturate}) {
    const ResolvedRange r = resolve({0, 4}, 5, rule, rule);
    EXPECT_FALSE(r.blocked);
    EXPECT_EQ(r.inside, (IndexRange{0, 4}));
  }
}

TEST(Outside, UnsafeBlocksWhateverTheOtherSideSays) {
  EXPECT_TRUE(resolve({-1, 2}, 5, kUnsafe, kSafe).blocked);
  EXPECT_TRUE(resolve({3, 5}, 5, kSafe, kUnsafe).blocked);
  EXPECT_TRUE(resolve({-1, 5}, 5, kSafe, kUnsafe).blocked);
  EXPECT_FALSE(resolve({-1, 4}, 5, kSafe, kUnsafe).blocked);
}

TEST(Outside, SafeDropsWhatLeft) {
  EXPECT_EQ(resolve({-3, 2}, 5, kSafe, kUnsafe).inside, (IndexRange{0, 2}));
  EXPECT_EQ(resolve({3, 9}, 5, kUnsafe, kSafe).inside, (IndexRange{3, 4}));
  EXPECT_TRUE(resolve({5, 9}, 5, kUnsafe, kSafe).all_left());
  EXPECT_TRUE(resolve({-9, -1}, 5, kSafe, kUnsafe).all_left());
}

TEST(Outside, SaturateMovesToTheBoundaryCell) {
  EXPECT_EQ(resolve({-9, -2}, 5, kSaturate, kUnsafe).inside, (IndexRange{0, 0}));
  EXPECT_EQ(resolve({-9, 2}, 5, kSaturate, kUnsafe).inside, (IndexRange{0, 2}));
  EXPECT_EQ(resolve({7, 9}, 5, kUnsafe, kSaturate).inside, (IndexRange{4, 4}));
  EXPECT_EQ(resolve({-9, 9}, 5, kSafe, kSaturate).inside, (IndexRange{0, 4}));
  EXPECT_TRUE(resolve({-9, -7}, 5, kSafe, kSaturate).all_left());
}

TEST(Outside, PeriodicTakesIndicesModuloTheirNumber) {
  const auto inside = [](std::int32_t first, std::int32_t last) {
    const ResolvedRange r = resolve({first, last}, 5, Outside::periodic, Outside::periodic);
    EXPECT_FALSE(r.blocked);
    EXPECT_FALSE(r.all_left());
    return r.inside;
  };
  EXPECT_EQ(inside(1, 3), (IndexRange{1, 3}));
  EXPECT_EQ(inside(-1, 1), (IndexRange{4, 6}));
  EXPECT_EQ(inside(-11, -8), (IndexRange{4, 7}));
  EXPECT_EQ(inside(23, 24), (IndexRange{3, 4}));
  EXPECT_EQ(inside(3, 7), (IndexRange{0, 4}));
  EXPECT_EQ(inside(-100, 100), (IndexRange{0, 4}));
}

TEST(Outside, OnARingAnIndexThatLostItsPlaceMeansAllCells) {
  const std::int32_t far = saturate_index(std::int64_t{1} << 40);
  const std::int32_t low = saturate_index(-(std::int64_t{1} << 40));
  for (const IndexRange raw : {IndexRange{far, far}, IndexRange{low, low}, IndexRange{low, far}}) {
    EXPECT_EQ(resolve(raw, 5, Outside::periodic, Outside::periodic).inside, (IndexRange{0, 4}));
  }
}

TEST(Outside, StopReadsBeyondTheLimitAsTheBoundaryCell) {
  EXPECT_EQ(resolve({-9, 9}, 5, Outside::stop, Outside::stop).inside, (IndexRange{0, 4}));
  EXPECT_EQ(resolve({6, 9}, 5, Outside::unsafe, Outside::stop).inside, (IndexRange{4, 4}));
}

TEST(Outside, FarIndicesSaturateInsteadOfWrapping) {
  EXPECT_EQ(saturate_index(std::int64_t{1} << 40), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(saturate_index(-(std::int64_t{1} << 40)), std::numeric_limits<std::int32_t>::min());
  EXPECT_TRUE(resolve({saturate_index(std::int64_t{1} << 40), saturate_index(std::int64_t{1} << 41)},
                      2147483645, kUnsafe, kUnsafe)
                  .blocked);
}

TEST(Moved, WhatWasSaturatedStaysSo) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(moved({-3, 4}, 10), (IndexRange{7, 14}));
  EXPECT_EQ(moved({kHigh - 1, kHigh}, 10), (IndexRange{kHigh, kHigh}));
  EXPECT_EQ(moved({kLow, 5}, 10), (IndexRange{kLow, 15}));
  EXPECT_LT(moved({kLow, kLow}, kHigh).last, 0);
  // On a ring the place is lost with it.
  EXPECT_EQ(wrap_range(moved({kLow, kLow}, 3), 7), (IndexRange{0, 6}));
  EXPECT_EQ(wrap_range(moved({kHigh, kHigh}, 3), 7), (IndexRange{0, 6}));
}

TEST(OutsideTraits, SayWhatEveryRuleDoes) {
  EXPECT_TRUE(traits(Outside::unsafe).blocks);
  EXPECT_TRUE(traits(Outside::safe).arrives);
  EXPECT_TRUE(traits(Outside::saturate).clamps && traits(Outside::saturate).resets);
  EXPECT_TRUE(traits(Outside::stop).clamps && traits(Outside::stop).stops);
  EXPECT_TRUE(traits(Outside::periodic).wraps);
}

TEST(OutsideTraits, HaveOneFateForWhatLeaves) {
  for (const OutsideTraits& rule : kOutsideTraits) {
    EXPECT_EQ(rule.blocks + rule.arrives + rule.clamps + rule.wraps, 1);
    EXPECT_EQ(rule.resets || rule.stops, rule.clamps);
  }
}

}  // namespace
}  // namespace coordreq

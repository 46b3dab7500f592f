#include "grid/outside.hpp"

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

TEST(Outside, FarIndicesSaturateInsteadOfWrapping) {
  EXPECT_EQ(saturate_index(std::int64_t{1} << 40), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(saturate_index(-(std::int64_t{1} << 40)), std::numeric_limits<std::int32_t>::min());
  EXPECT_TRUE(resolve({saturate_index(std::int64_t{1} << 40), saturate_index(std::int64_t{1} << 41)},
                      2147483645, kUnsafe, kUnsafe)
                  .blocked);
}

}  // namespace
}  // namespace coordreq

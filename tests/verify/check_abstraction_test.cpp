#include "verify/check_abstraction.hpp"

#include <gtest/gtest.h>

#include "verify/posts.hpp"

namespace coordreq {
namespace {

GridDimension line(std::int64_t count, Outside below, Outside above) {
  return {.name = "x",
          .first = 0,
          .step = 1,
          .count = count,
          .below = below,
          .above = above,
          .lower = 0,
          .upper = 9};
}

Finding compare(const GridDimension& dimension, IndexRange own, IndexRange claimed, bool exact) {
  const PostTable mine{.entries = {own}, .exact = exact};
  const PostTable theirs{.entries = {claimed}};
  return check_abstraction(dimension, mine, theirs, "abstraction");
}

TEST(CheckAbstraction, AnExactRangeHasToBeEqualAnEnclosureInside) {
  const GridDimension x = line(9, Outside::unsafe, Outside::unsafe);
  EXPECT_EQ(compare(x, {2, 4}, {2, 4}, true).wrong, 0);
  EXPECT_EQ(compare(x, {2, 4}, {1, 4}, true).wrong, 1);
  EXPECT_EQ(compare(x, {2, 4}, {1, 4}, false).wrong, 0);
  EXPECT_EQ(compare(x, {2, 4}, {3, 4}, false).wrong, 1);
  EXPECT_EQ(compare(x, {2, 4}, {2, 3}, false).wrong, 1);
  EXPECT_EQ(compare(x, {2, 4}, {2, 3}, false).examples.front(), "entry 0: 2..3, expected at least 2..4");
}

TEST(CheckAbstraction, RangesOfARingAreComparedAfterWrappingRound) {
  const GridDimension ring = line(9, Outside::periodic, Outside::periodic);
  EXPECT_EQ(compare(ring, {-1, 1}, {8, 10}, true).wrong, 0);
  EXPECT_EQ(compare(ring, {8, 10}, {-2, 1}, false).wrong, 0);
  EXPECT_EQ(compare(ring, {8, 10}, {0, 2}, false).wrong, 1);
  EXPECT_EQ(compare(ring, {8, 10}, {3, 11}, false).wrong, 0);
}

TEST(AfterLeaving, EverySideDoesWhatItsRuleSays) {
  const auto left = [](IndexRange raw, Outside below, Outside above) {
    return after_leaving(raw, line(5, below, above));
  };
  EXPECT_TRUE(left({-1, 2}, Outside::unsafe, Outside::safe).blocked);
  EXPECT_TRUE(left({-1, 7}, Outside::safe, Outside::unsafe).blocked);
  EXPECT_EQ(left({-1, 2}, Outside::safe, Outside::unsafe).inside, (IndexRange{0, 2}));
  EXPECT_TRUE(left({-3, -1}, Outside::safe, Outside::unsafe).all_left());
  EXPECT_TRUE(left({5, 8}, Outside::unsafe, Outside::safe).all_left());
  EXPECT_EQ(left({-3, -1}, Outside::saturate, Outside::unsafe).inside, (IndexRange{0, 0}));
  EXPECT_EQ(left({6, 8}, Outside::unsafe, Outside::saturate).inside, (IndexRange{4, 4}));
  EXPECT_EQ(left({3, 8}, Outside::unsafe, Outside::stop).inside, (IndexRange{3, 4}));
  EXPECT_EQ(left({-1, 1}, Outside::periodic, Outside::periodic).inside, (IndexRange{4, 6}));
  EXPECT_EQ(left({-1, 9}, Outside::periodic, Outside::periodic).inside, (IndexRange{0, 4}));
}

}  // namespace
}  // namespace coordreq

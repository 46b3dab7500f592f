#include "verify/checks.hpp"

#include <gtest/gtest.h>

#include "answers/checking/posts.hpp"

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

Finding compare(const GridDimension& dimension, IndexRange expected, IndexRange claimed) {
  const UniformGrid grid({dimension});
  const InputSpace inputs({{"u", {5}}});
  const auto table = [&grid](IndexRange range) {
    PostTable result{.states = {0}, .entries = {}, .state_stride = {1}, .input_stride = {0}};
    result.entries.assign(static_cast<std::size_t>(grid[0].count), range);
    return result;
  };
  const PostTable one = subset_of(table(expected), grid, inputs, {2});
  return check_abstraction(grid, inputs, 0, one, table(claimed), "abstraction");
}

TEST(CheckAbstraction, AnExactRangeHasToBeEqual) {
  const GridDimension x = line(9, Outside::unsafe, Outside::unsafe);
  EXPECT_EQ(compare(x, {2, 4}, {2, 4}).wrong, 0);
  EXPECT_EQ(compare(x, {2, 4}, {1, 4}).wrong, 1);
  EXPECT_EQ(compare(x, {2, 4}, {2, 3}).wrong, 1);
  EXPECT_EQ(compare(x, {2, 4}, {2, 3}).checked, 1);
  EXPECT_EQ(compare(x, {2, 4}, {2, 3}).examples.front(), "x = 2: x 2 to 3, expected 2 to 4");
}

TEST(CheckAbstraction, RangesOfARingAreComparedAfterWrappingRound) {
  const GridDimension ring = line(9, Outside::periodic, Outside::periodic);
  EXPECT_EQ(compare(ring, {-1, 1}, {8, 10}).wrong, 0);
  EXPECT_EQ(compare(ring, {8, 10}, {-2, 1}).wrong, 1);
  EXPECT_EQ(compare(ring, {8, 10}, {0, 2}).wrong, 1);
}

TEST(Holds, AskInARingForTheArc) {
  const GridDimension ring = line(9, Outside::periodic, Outside::periodic);
  EXPECT_TRUE(holds(ring, {-2, 1}, {8, 10}));
  EXPECT_TRUE(holds(ring, {3, 11}, {8, 10}));
  EXPECT_FALSE(holds(ring, {0, 2}, {8, 10}));
  EXPECT_FALSE(holds(ring, {8, 9}, {8, 10}));
  EXPECT_TRUE(holds(line(9, Outside::unsafe, Outside::unsafe), {1, 4}, {2, 4}));
  EXPECT_FALSE(holds(line(9, Outside::unsafe, Outside::unsafe), {3, 4}, {2, 4}));
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
  EXPECT_TRUE(left({5, 8}, Outside::unsafe, Outside::goal).all_left());
  EXPECT_EQ(left({-3, -1}, Outside::saturate, Outside::unsafe).inside, (IndexRange{0, 0}));
  EXPECT_EQ(left({6, 8}, Outside::unsafe, Outside::saturate).inside, (IndexRange{4, 4}));
  EXPECT_EQ(left({3, 8}, Outside::unsafe, Outside::stop).inside, (IndexRange{3, 4}));
  EXPECT_EQ(left({-1, 1}, Outside::periodic, Outside::periodic).inside, (IndexRange{4, 6}));
  EXPECT_EQ(left({-1, 9}, Outside::periodic, Outside::periodic).inside, (IndexRange{0, 4}));
}

}  // namespace
}  // namespace coordreq

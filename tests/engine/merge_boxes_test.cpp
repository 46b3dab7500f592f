#include "engine/merge_boxes.hpp"
#include "support/draw.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <set>

namespace coordreq {
namespace {

BoxList boxes(std::size_t dimensions, std::vector<IndexRange> ranges) {
  return {.dimensions = dimensions, .ranges = std::move(ranges)};
}

std::vector<IndexRange> merged(std::size_t dimensions, std::vector<IndexRange> ranges,
                               std::int64_t longest = 100) {
  BoxList list = boxes(dimensions, std::move(ranges));
  const std::vector<std::int64_t> limits(dimensions, longest);
  merge_boxes(list, limits);
  return list.ranges;
}

using Ranges = std::vector<IndexRange>;

TEST(MergeBoxes, NeighboursAreJoinedAndGapsStay) {
  EXPECT_EQ(merged(1, {{0, 1}, {2, 3}}), (Ranges{{0, 3}}));
  EXPECT_EQ(merged(1, {{2, 3}, {0, 1}}), (Ranges{{0, 3}}));
  EXPECT_EQ(merged(1, {{0, 1}, {3, 4}}), (Ranges{{0, 1}, {3, 4}}));
  EXPECT_EQ(merged(1, {{3, 4}, {0, 1}}), (Ranges{{3, 4}, {0, 1}}));
  // The third fills the gap.
  EXPECT_EQ(merged(1, {{0, 1}, {3, 4}, {2, 2}}).size(), 1U);
  EXPECT_EQ(merged(1, {{-7, 2}, {0, 5}}), (Ranges{{-7, 5}}));
}

TEST(MergeBoxes, OnlyBoxesThatDifferInOneDimensionAreJoined) {
  EXPECT_EQ(merged(2, {{0, 1}, {5, 6}, {2, 3}, {5, 6}}), (Ranges{{0, 3}, {5, 6}}));
  EXPECT_EQ(merged(2, {{0, 1}, {5, 6}, {2, 3}, {5, 7}}), (Ranges{{0, 1}, {5, 6}, {2, 3}, {5, 7}}));
}

TEST(MergeBoxes, BoxesInsideOthersGo) {
  EXPECT_EQ(merged(2, {{0, 4}, {0, 4}, {1, 2}, {3, 4}}), (Ranges{{0, 4}, {0, 4}}));
  EXPECT_EQ(merged(2, {{1, 2}, {3, 4}, {0, 4}, {0, 4}}), (Ranges{{0, 4}, {0, 4}}));
  EXPECT_EQ(merged(2, {{1, 2}, {3, 4}, {1, 2}, {3, 4}}), (Ranges{{1, 2}, {3, 4}}));
}

TEST(MergeBoxes, NothingGetsLongerThanTheRing) {
  EXPECT_EQ(merged(1, {{0, 3}, {4, 7}}, 8), (Ranges{{0, 7}}));
  EXPECT_EQ(merged(1, {{0, 3}, {4, 8}}, 8), (Ranges{{0, 3}, {4, 8}}));
}

TEST(MergeBoxes, EndsOfTheNumbersDoNotOverflow) {
  EXPECT_EQ(merged(1, {{INT32_MIN, 0}, {5, INT32_MAX}}, INT32_MAX), (Ranges{{INT32_MIN, 0}, {5, INT32_MAX}}));
  EXPECT_EQ(merged(1, {{5, INT32_MAX}, {INT32_MIN, 0}}, INT32_MAX), (Ranges{{5, INT32_MAX}, {INT32_MIN, 0}}));
}

/// The cells of all boxes.
std::set<std::vector<int>> cells(const BoxList& list) {
  std::set<std::vector<int>> result;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::vector<std::vector<int>> some = {{}};
    for (const IndexRange& range : list[i]) {
      std::vector<std::vector<int>> longer;
      for (const std::vector<int>& cell : some) {
        for (int k = range.first; k <= range.last; ++k) {
          longer.push_back(cell);
          longer.back().push_back(k);
        }
      }
      some = std::move(longer);
    }
    result.insert(some.begin(), some.end());
  }
  return result;
}

TEST(MergeBoxes, TheUnionStaysAsItIs) {
  EXPECT_TRUE(rc::check("same cells, no box in another, none too long", [] {
    const auto dimensions = static_cast<std::size_t>(draw(1, 3));
    std::vector<std::int64_t> longest;
    for (std::size_t i = 0; i < dimensions; ++i) longest.push_back(draw(0, 1) == 0 ? draw(2, 5) : INT32_MAX);
    BoxList list = boxes(dimensions, {});
    const int count = draw(0, 9);
    for (int k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < dimensions; ++i) {
        const int first = draw(-1, 4);
        list.ranges.push_back({first, first + draw(0, 1) + draw(0, 1) * draw(0, 1)});
        IndexRange& range = list.ranges.back();
        range.last = std::min<std::int32_t>(
            range.last, range.first + static_cast<std::int32_t>(std::min<std::int64_t>(longest[i], 9)) - 1);
      }
    }
    const auto before = cells(list);
    const std::size_t size = list.size();
    merge_boxes(list, longest);
    RC_CLASSIFY(list.size() < size, "fewer boxes");
    RC_ASSERT(list.size() <= size);
    RC_ASSERT(cells(list) == before);
    for (std::size_t a = 0; a < list.size(); ++a) {
      for (std::size_t i = 0; i < dimensions; ++i)
        RC_ASSERT(list[a][i].last - std::int64_t{list[a][i].first} < longest[i]);
      for (std::size_t b = 0; b < list.size(); ++b) RC_ASSERT(a == b || !is_inside(list[a], list[b]));
    }
  }));
}

}  // namespace
}  // namespace coordreq

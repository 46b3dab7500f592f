#include "engine/list_numbers.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

using Numbers = ListNumbers<std::uint64_t>;
using List = std::vector<std::uint64_t>;

TEST(ListNumbers, AreTheSameForEqualListsOnly) {
  Numbers lists;
  for (std::uint64_t k = 0; k < 1000; ++k) EXPECT_EQ(lists.number(List{k % 10, k / 10}), k);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    EXPECT_EQ(lists.number(List{k % 10, k / 10}), k);
    EXPECT_EQ(lists[static_cast<std::uint32_t>(k)][1], k / 10);
  }
  EXPECT_EQ(lists.size(), 1000U);
}

TEST(ListNumbers, ListsOfDifferentLengthsDiffer) {
  Numbers lists;
  EXPECT_EQ(lists.number(List{}), 0U);
  EXPECT_EQ(lists.number(List{0}), 1U);
  EXPECT_EQ(lists.number(List{0, 0}), 2U);
  EXPECT_EQ(lists.number(List{}), 0U);
  EXPECT_TRUE(lists[0].empty());
  EXPECT_EQ(lists[2].size(), 2U);
}

TEST(ListNumbers, StartAgainAfterClear) {
  Numbers lists;
  for (std::uint64_t k = 0; k < 100; ++k) static_cast<void>(lists.number(List{k}));
  lists.clear();
  EXPECT_EQ(lists.size(), 0U);
  EXPECT_EQ(lists.number(List{7}), 0U);
  EXPECT_EQ(lists.number(List{5}), 1U);
  EXPECT_EQ(lists.number(List{7}), 0U);
}

}  // namespace
}  // namespace coordreq

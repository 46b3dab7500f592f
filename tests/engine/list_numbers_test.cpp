#include "engine/list_numbers.hpp"

#include <gtest/gtest.h>

#include <map>

#include "base/thread_team.hpp"
#include "engine/shared_list_numbers.hpp"
#include "engine/tiles.hpp"

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

TEST(SharedListNumbers, AreTheSameForEqualListsOnlyWhicheverThreadAsks) {
  constexpr std::int64_t kLists = 500, kTimes = 8;
  SharedListNumbers lists;
  std::vector<std::uint32_t> numbers(kLists * kTimes);
  std::vector<std::int64_t> noted(kLists << SharedListNumbers::kBits, 0);
  ThreadTeam team(4);
  team.for_each(std::ssize(numbers), 16, [&](ThreadTeam::Range range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const std::vector<std::uint32_t> list{1, 1, 1, static_cast<std::uint32_t>(k % kLists)};
      numbers[static_cast<std::size_t>(k)] = lists.number(list, [&](std::size_t shard, std::uint32_t number) {
        noted[number << SharedListNumbers::kBits | shard] += 1;
      });
    }
  });
  std::map<std::uint32_t, std::int64_t> list_of;
  for (std::int64_t k = 0; k < std::ssize(numbers); ++k) {
    const std::uint32_t number = numbers[static_cast<std::size_t>(k)];
    EXPECT_EQ(list_of.emplace(number, k % kLists).first->second, k % kLists);
    EXPECT_EQ(noted.at(number), kTimes);
  }
  EXPECT_EQ(std::ssize(list_of), kLists);
}

TEST(NumberRows, NumbersAreTheSameForEqualRowsOnlyWhoeverLooks) {
  // More rows than are looked up at once; some are equal to a row before them, some are not.
  constexpr std::int64_t kRows = 20'000, kCells = 70;
  CellSet set(kRows, kCells);
  std::map<std::vector<Word>, std::uint32_t> expected;
  for (std::int64_t r = 0; r < kRows; ++r) {
    set.row(r)[0] = static_cast<Word>(r * r % 1009);
    set.row(r)[1] = static_cast<Word>(r / 5000);
    const std::vector<Word> words(set.row(r).begin(), set.row(r).end());
    expected.emplace(words, static_cast<std::uint32_t>(expected.size()));
  }
  for (const int threads : {1, 4}) {
    ThreadTeam team(threads);
    const Tiles::Numbers numbers = number_rows(set, nullptr, &team);
    ASSERT_EQ(std::ssize(numbers), kRows);
    for (std::int64_t r = 0; r < kRows; ++r) {
      const std::vector<Word> words(set.row(r).begin(), set.row(r).end());
      ASSERT_EQ(numbers[static_cast<std::size_t>(r)], expected.at(words)) << r;
    }
  }
}

}  // namespace
}  // namespace coordreq

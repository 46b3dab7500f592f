#include "ranks/row_share.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "support/thread_ranks.hpp"

namespace coordreq {
namespace {

using Runs = std::vector<std::pair<std::int64_t, std::int64_t>>;

Runs runs(const std::vector<RowShare::Range>& ranges) {
  Runs result;
  for (const RowShare::Range range : ranges) result.emplace_back(range.begin, range.end);
  return result;
}

TEST(RowShare, OwnersAreThoseOfTheRunsEmptyOnesLeftOut) {
  ThreadRanks::run(4, [](Ranks& ranks) {
    const RowShare share(ranks, {0, 3, 3, 5, 9});
    const std::vector<int> expected = {0, 0, 0, 2, 2, 3, 3, 3, 3};
    for (std::size_t row = 0; row < expected.size(); ++row)
      EXPECT_EQ(share.owner(static_cast<std::int64_t>(row)), expected[row]);
    EXPECT_EQ(share.run_of(1).begin, share.run_of(1).end);
  });
}

TEST(RowShare, OwnersHearOfGhosts) {
  ThreadRanks::run(3, [](Ranks& ranks) {
    RowShare share(ranks, {0, 4, 8, 12});
    std::vector<std::uint8_t> is_met(12, 0);
    if (ranks.rank() == 0) is_met = {1, 1, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1};
    if (ranks.rank() == 2) is_met[2] = 1;
    share.set_ghosts(is_met);
    if (ranks.rank() == 0) {
      EXPECT_EQ(runs(share.held()), (Runs{{0, 4}, {4, 5}, {6, 8}, {11, 12}}));
      ASSERT_EQ(share.peers().size(), 2U);
      EXPECT_EQ(runs(share.peers()[0].received), (Runs{{4, 5}, {6, 8}}));
      EXPECT_EQ(runs(share.peers()[0].sent), (Runs{}));
      EXPECT_EQ(runs(share.peers()[1].sent), (Runs{{2, 3}}));
    }
    if (ranks.rank() == 1) {
      EXPECT_EQ(runs(share.held()), (Runs{{4, 8}}));
      ASSERT_EQ(share.peers().size(), 1U);
      EXPECT_EQ(runs(share.peers()[0].sent), (Runs{{4, 5}, {6, 8}}));
    }
  });
}

TEST(Ranks, MessageOfTheFirstReachesAll) {
  for (int count = 1; count <= 9; ++count) {
    std::atomic<int> reached = 0;
    ThreadRanks::run(count, [&](Ranks& ranks) {
      const Bytes message = ranks.from_first(ranks.rank() == 0 ? Bytes(3, std::byte{7}) : Bytes());
      if (message == Bytes(3, std::byte{7})) ++reached;
      EXPECT_EQ(ranks.sum(ranks.rank()), count * (count - 1) / 2);
      EXPECT_EQ(ranks.greatest(-ranks.rank()), 0);
    });
    EXPECT_EQ(reached, count);
  }
}

TEST(MessageReader, AShortMessageIsAnError) {
  const Bytes message(5);
  MessageReader reader(message);
  EXPECT_THROW(static_cast<void>(reader.number()), std::out_of_range);
}

}  // namespace
}  // namespace coordreq

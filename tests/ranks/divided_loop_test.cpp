#include "ranks/divided_loop.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "model/outside.hpp"
#include "support/thread_ranks.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kLengths[] = {0, 1, 4, 7, 200000};

TEST(DividedLoop, EveryIndexIsRunByOneRankAndKnownToAll) {
  for (const std::int64_t count : kLengths) {
    ThreadRanks::run(5, [&](Ranks& ranks) {
      ThreadTeam team(2);
      std::vector<IndexRange> ranges(static_cast<std::size_t>(count));
      for_each_divided(&ranks, team, count, 16, [&](ThreadTeam::Range range, int) {
        for (std::int64_t i = range.begin; i < range.end; ++i) {
          IndexRange& one = ranges[static_cast<std::size_t>(i)];
          one = {one.first + 1, static_cast<std::int32_t>(-i)};
        }
      });
      join_segments(&ranks, std::span(ranges));
      for (std::int64_t i = 0; i < count; ++i)
        EXPECT_EQ(ranges[static_cast<std::size_t>(i)], (IndexRange{1, static_cast<std::int32_t>(-i)}));
    });
  }
}

TEST(DividedLoop, AllAreToldAllParts) {
  for (const std::int64_t count : kLengths) {
    ThreadRanks::run(3, [&](Ranks& ranks) {
      const ThreadTeam::Range own = divided_range(&ranks, count);
      std::vector<IndexRange> part;
      for (std::int64_t i = own.begin; i < own.end; ++i)
        part.push_back({static_cast<std::int32_t>(-i), ranks.rank()});
      std::int64_t told = 0, first_of_rank = 0;
      exchange_all(ranks, count, own.begin, std::span<const IndexRange>(part), [&](IndexRange one) {
        EXPECT_EQ(one.first, -told++);
        EXPECT_GE(one.last, first_of_rank);
        first_of_rank = one.last;
      });
      EXPECT_EQ(told, count);
    });
  }
}

TEST(DividedLoop, OfSeveralErrorsThatOfTheLowestIndexCounts) {
  for (const int lowest : {0, 13, 14, 99}) {
    const auto run = [&] {
      ThreadRanks::run(3, [&](Ranks& ranks) {
        ThreadTeam team(2);
        for_each_divided(&ranks, team, 100, 1, [&](ThreadTeam::Range range, int) {
          if (range.begin >= lowest) throw std::runtime_error(std::to_string(range.begin));
        });
        ADD_FAILURE() << "went on after an error";
      });
    };
    try {
      run();
      ADD_FAILURE() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::to_string(lowest));
    }
  }
}

TEST(DividedLoop, OneProcessRunsAll) {
  ThreadTeam team(1);
  std::vector<std::int64_t> values(3, 5);
  for_each_divided(nullptr, team, 3, 1, [&](ThreadTeam::Range range, int) {
    values[static_cast<std::size_t>(range.begin)] += range.begin;
  });
  join_segments(nullptr, std::span(values));
  EXPECT_EQ(values, (std::vector<std::int64_t>{5, 6, 7}));
}

}  // namespace
}  // namespace coordreq

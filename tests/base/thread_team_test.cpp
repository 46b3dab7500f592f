#include "base/thread_team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace coordreq {
namespace {

TEST(ThreadTeam, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 7}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.size(), threads);
    for (const std::int64_t count : {0, 1, 9, 1000}) {
      for (const std::int64_t grain : {1, 4, 5000}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
        team.for_each(count, grain, [&](ThreadTeam::Range range, int worker) {
          EXPECT_LE(range.end - range.begin, grain);
          EXPECT_LT(worker, threads);
          for (std::int64_t i = range.begin; i < range.end; ++i) ++visits[static_cast<std::size_t>(i)];
        });
        for (const auto& visit : visits) EXPECT_EQ(visit, 1);
      }
    }
  }
}

TEST(ThreadTeam, CarriesAnExceptionOutAndStaysUsable) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    const auto fails = [](ThreadTeam::Range range, int) {
      if (range.begin == 50) throw std::runtime_error("fifty");
    };
    EXPECT_THROW(team.for_each(100, 1, fails), std::runtime_error);
    std::atomic<int> sum = 0;
    team.for_each(100, 3,
                  [&](ThreadTeam::Range range, int) { sum += static_cast<int>(range.end - range.begin); });
    EXPECT_EQ(sum, 100);
  }
}

TEST(ThreadTeam, RunsManyShortLoops) {
  ThreadTeam team(4);
  std::atomic<std::int64_t> sum = 0;
  for (int loop = 0; loop < 2000; ++loop) {
    team.for_each(8, 1, [&](ThreadTeam::Range range, int) { sum += range.begin; });
  }
  EXPECT_EQ(sum, 2000 * 28);
}

}  // namespace
}  // namespace coordreq

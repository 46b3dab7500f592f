#include "base/thread_team.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
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

TEST(ThreadTeam, TakesShortAndLongLoopsOfMoreThreadsThanProcessors) {
  ThreadTeam team(40);
  std::atomic<std::int64_t> sum = 0;
  for (int loop = 0; loop < 500; ++loop) {
    team.for_each(loop % 3 == 0 ? 200 : 2, 1, [&](ThreadTeam::Range range, int) {
      sum += range.begin;
      if (range.begin % 50 == 49) std::this_thread::yield();
    });
  }
  EXPECT_EQ(sum, 167 * 19900 + 333);
}

TEST(ThreadTeam, TellsHowFarALoopHasCome) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    std::vector<std::int64_t> told;
    team.set_watch([&](std::int64_t done, std::int64_t count) {
      EXPECT_EQ(count, 100);
      told.push_back(done);
    });
    team.for_each(100, 7, [](ThreadTeam::Range, int) {});
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.size(), threads == 1 ? 15U : told.size());
    EXPECT_TRUE(told.empty() || told.back() <= 100);
    EXPECT_TRUE(threads > 1 || told.back() == 100);
    team.set_watch({});
    told.clear();
    team.for_each(100, 7, [](ThreadTeam::Range, int) {});
    EXPECT_TRUE(told.empty());
  }
}

TEST(ThreadTeam, AWatchCanEndALoop) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    team.set_watch([](std::int64_t, std::int64_t) { throw std::runtime_error("enough"); });
    std::atomic<bool> main_works = false;
    const auto wait_for_main = [&](ThreadTeam::Range, int worker) {
      if (worker == 0) main_works = true;
      while (!main_works) std::this_thread::yield();
    };
    EXPECT_THROW(team.for_each(100, 1, wait_for_main), std::runtime_error);
    team.set_watch({});
    EXPECT_NO_THROW(team.for_each(100, 1, wait_for_main));
  }
}

}  // namespace
}  // namespace coordreq

#include "base/process_memory.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "base/error.hpp"
#include "base/sanitizers.hpp"
#include "base/thread_team.hpp"
#include "base/timer.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMebi = std::size_t{1} << 20U;

bool is_granted(std::size_t bytes) {
  try {
    const std::vector<char> taken(bytes, 'x');
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

/// In a process of its own: a limit cannot be taken back for others. Exits with 0 if `holds`.
template <class Holds>
void hold(std::size_t more, const Holds& holds) {
  hold_to_memory(resident_bytes() + more);
  std::_Exit(is_held_to_memory() && holds() ? 0 : 1);
}

TEST(HoldToMemory, RefusesWhatGoesBeyond) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  EXPECT_FALSE(is_held_to_memory());
  EXPECT_EXIT(hold(64 * kMebi, [] { return is_granted(32 * kMebi) && !is_granted(80 * kMebi); }),
              testing::ExitedWithCode(0), "");
}

TEST(HoldToMemory, GrantsLittleSoThatItCanBeSaid) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  EXPECT_EXIT(hold(0, [] { return is_granted(kMebi) && !is_granted(16 * kMebi); }),
              testing::ExitedWithCode(0), "");
}

TEST(HoldToMemory, StacksOfThreadsAreNoRoomForAnythingElse) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  const auto holds = [] {
    bool fits = true, is_refused = true;
    for (int round = 0; round < 3; ++round) {
      {
        ThreadTeam team(16);
        fits = fits && team.size() == 16 && is_granted(32 * kMebi);
        is_refused = is_refused && !is_granted(80 * kMebi);
      }
      fits = fits && is_granted(32 * kMebi);
      is_refused = is_refused && !is_granted(80 * kMebi);
    }
    return fits && is_refused;
  };
  EXPECT_EXIT(hold(64 * kMebi, holds), testing::ExitedWithCode(0), "");
}

TEST(ThreadsWithin, AreAsManyAsAskedForWhereThereIsRoom) {
  const MemoryDemand demand{.once = 10.0 * kMebi, .of_thread = 1.0 * kMebi};
  EXPECT_EQ(threads_within("it needs", demand, 7, std::nullopt), 7);
  EXPECT_EQ(threads_within("it needs", demand, 7, std::uint64_t{1} << 40U), 7);
}

TEST(ThreadsWithin, AreFewerWhereMemoryIsShort) {
  const MemoryDemand demand{.once = 100.0 * kMebi, .of_thread = 10.0 * kMebi};
  const auto limit = static_cast<std::uint64_t>(memory_of_program()) + 146 * kMebi;
  EXPECT_EQ(threads_within("it needs", demand, 64, limit), 4);
}

TEST(ThreadsWithin, ThrowsWithTheNeedIfOneIsTooMany) {
  const MemoryDemand demand{.once = 100.0 * kMebi, .of_thread = 10.0 * kMebi};
  try {
    static_cast<void>(threads_within("it needs", demand, 2, 50 * kMebi));
    FAIL() << "expected a LimitError";
  } catch (const LimitError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.substr(0, 15), "it needs about ");
    EXPECT_EQ(what.substr(what.find(" of memory")), " of memory, the limit is 50.0 MiB (--max-memory)");
  }
}

TEST(CheckMemoryNeed, TheLimitItselfIsEnough) {
  EXPECT_NO_THROW(check_memory_need("it needs", kMebi, kMebi, ""));
  EXPECT_THROW(check_memory_need("it needs", 1.01 * kMebi, kMebi, ""), LimitError);
}

TEST(BytesInWords, HasATenthAndAUnit) {
  EXPECT_EQ(byte_text(512), "512.0 B");
  EXPECT_EQ(byte_text(1536), "1.5 KiB");
  EXPECT_EQ(byte_text(25.0 * kMebi), "25.0 MiB");
}

}  // namespace
}  // namespace coordreq

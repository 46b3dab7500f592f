#include "app/option_values.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(MemorySize, UnitsArePowersOf1024) {
  EXPECT_EQ(memory_size("1048576", "--max-memory"), 1U << 20U);
  EXPECT_EQ(memory_size("3K", "--max-memory"), 3U << 10U);
  EXPECT_EQ(memory_size("1.5MiB", "--max-memory"), 3U << 19U);
  EXPECT_EQ(memory_size("2gb", "--max-memory"), std::uint64_t{1} << 31U);
  EXPECT_EQ(memory_size("1T", "--max-memory"), std::uint64_t{1} << 40U);
}

}  // namespace
}  // namespace coordreq

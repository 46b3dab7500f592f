#include "app/options.hpp"

#include <gtest/gtest.h>

#include "app/option_values.hpp"

namespace coordreq {
namespace {

TEST(CommonOptions, ProcessesShareTheMemoryOfTheMachine) {
  const std::optional<std::uint64_t> all = available_memory();
  ASSERT_TRUE(all);
  CommonOptions common;
  EXPECT_EQ(common.memory(), all);
  common.sharers = 3;
  EXPECT_EQ(common.memory(), *all / 3);
}

TEST(CommonOptions, WhatIsAskedForIsOfEach) {
  CommonOptions common;
  common.max_memory = 1000;
  common.sharers = 2;
  EXPECT_EQ(common.memory(), 1000U);
}

}  // namespace
}  // namespace coordreq

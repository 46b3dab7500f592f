#include "base/requires.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

int half(int whole) {
  REQUIRES(whole % 2 == 0);
  return whole / 2;
}

TEST(Requires, EndsTheProgramWhereAssertionsAreOn) {
  EXPECT_EQ(half(6), 3);
#ifdef NDEBUG
  EXPECT_EQ(half(7), 3);
#else
  EXPECT_DEATH(static_cast<void>(half(7)), "whole % 2 == 0");
#endif
}

}  // namespace
}  // namespace coordreq

#include "spec/units.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(TimeText, IsConvertedExactly) {
  EXPECT_EQ(time_in("500ms", "s"), Rational(1, 2));
  EXPECT_EQ(time_in("10 min", "s"), Rational(600));
  EXPECT_EQ(time_in("1h", "min"), Rational(60));
  EXPECT_EQ(time_in("1.5 hours", "minutes"), Rational(90));
  EXPECT_EQ(time_in(" 20 us ", "ms"), Rational(1, 50));
  EXPECT_EQ(time_in("1 d", "h"), Rational(24));
  EXPECT_EQ(time_in("2e3 ms", "s"), Rational(2));
  EXPECT_EQ(time_in("-1 s", "s"), Rational(-1));
}

TEST(TimeText, IsANumberAndAUnitOfTimeInAUnitOfTime) {
  for (const char* const text : {"", "5", "s", "5 m", "5 km/h", "5 s 3 ms", "x s", "pi s"})
    EXPECT_FALSE(time_in(text, "s")) << text;
  EXPECT_FALSE(time_in("5 s", ""));
  EXPECT_FALSE(time_in("5 s", "round"));
  EXPECT_TRUE(is_time_unit("seconds"));
  EXPECT_FALSE(is_time_unit("m"));
}

}  // namespace
}  // namespace coordreq

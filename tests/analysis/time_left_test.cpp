#include "analysis/time_left.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

Progress in_pass(std::int64_t done, std::int64_t all = 100) {
  return {.stage = "abstraction", .done = done, .all = all};
}

Progress in_sweep(std::int64_t sweep, std::int64_t visited, std::int64_t cells_left) {
  return {.stage = "layers", .sweep = sweep, .visited = visited, .cells_left = cells_left, .cells = 100};
}

TEST(TimeLeft, APassGoesOnAtItsRate) {
  TimeLeft left;
  left.update(in_pass(0), 10);
  left.update(in_pass(25), 12);
  EXPECT_DOUBLE_EQ(left.elapsed(), 2);
  EXPECT_DOUBLE_EQ(left.share().value(), 0.25);
  EXPECT_DOUBLE_EQ(left.seconds().value(), 6);
  left.update(in_pass(100), 18);
  EXPECT_DOUBLE_EQ(left.seconds().value(), 0);
}

TEST(TimeLeft, NothingIsSaidTooEarly) {
  TimeLeft left;
  left.update(in_pass(0), 0);
  left.update(in_pass(50), 0.5);
  EXPECT_FALSE(left.seconds());
  left.update(in_pass(51), 1.5);
  EXPECT_TRUE(left.seconds());
  TimeLeft slow;
  slow.update(in_pass(0, 1000), 0);
  slow.update(in_pass(1, 1000), 100);
  EXPECT_FALSE(slow.seconds());
}

TEST(TimeLeft, AnotherPassOrStageBeginsAnew) {
  TimeLeft left;
  left.update(in_pass(0), 0);
  left.update(in_pass(90), 9);
  left.update(in_pass(0, 50), 10);  // another pass
  EXPECT_FALSE(left.seconds());
  EXPECT_DOUBLE_EQ(left.elapsed(), 0);
  left.update(in_pass(25, 50), 15);
  EXPECT_DOUBLE_EQ(left.seconds().value(), 5);
  left.update(in_pass(1, 50), 16);  // one as long
  EXPECT_FALSE(left.seconds());
  left.update(in_sweep(1, 0, 100), 17);
  EXPECT_DOUBLE_EQ(left.elapsed(), 0);
}

TEST(TimeLeft, SweepsShrinkInTheRatioThatTheyHave) {
  TimeLeft left;
  left.update(in_sweep(1, 0, 100), 0);
  left.update(in_sweep(1, 50, 50), 5);
  EXPECT_DOUBLE_EQ(left.share().value(), 0.5);
  EXPECT_FALSE(left.seconds()) << "how the next sweep will be is not known";
  left.update(in_sweep(1, 80, 0), 8);
  left.update(in_sweep(2, 20, 50), 10);
  // 100 rows in 10 s; 20 more of this sweep, then 20 + 10 + 5 + ... = 40.
  EXPECT_NEAR(left.seconds().value(), 6, 1e-9);
}

TEST(TimeLeft, OfSweepsThatDoNotShrinkNothingIsKnown) {
  TimeLeft left;
  left.update(in_sweep(1, 0, 100), 0);
  left.update(in_sweep(1, 50, 0), 5);
  left.update(in_sweep(2, 25, 50), 8);
  EXPECT_FALSE(left.seconds());
  left.update(in_sweep(2, 24, 50), 9);  // 48 after 50: by so little nothing can be told of what follows
  EXPECT_FALSE(left.seconds());
}

TEST(TimeLeft, WorkOfWhichNothingIsKnownHasNoShare) {
  TimeLeft left;
  left.update({.stage = "reading"}, 0);
  left.update({.stage = "reading"}, 5);
  EXPECT_FALSE(left.share());
  EXPECT_FALSE(left.seconds());
  EXPECT_DOUBLE_EQ(left.elapsed(), 5);
}

}  // namespace
}  // namespace coordreq

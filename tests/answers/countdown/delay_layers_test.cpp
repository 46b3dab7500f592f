#include "answers/countdown/delay_layers.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(TriggerTable, WithoutConnectionDelayItIsThePapersCountdown) {
  for (const int delay : {0, 1, 28}) EXPECT_EQ(trigger_of(delay, 0), delay);
}

TEST(TriggerTable, CountsDownToTheStartOfConnecting) {
  EXPECT_EQ(trigger_of(5, 3), 2);
  EXPECT_EQ(trigger_of(3, 3), 0);
}

TEST(TriggerTable, TooLateMeansAConnectionMustStand) {
  EXPECT_EQ(trigger_of(2, 3), kMustBeConnected);
  EXPECT_EQ(trigger_of(0, 1), kMustBeConnected);
  EXPECT_EQ(trigger_of(7, std::int64_t{1} << 40), kMustBeConnected);
}

TEST(TriggerTable, UnboundedCellsNeverNeedTo) {
  EXPECT_EQ(trigger_of(kUnbounded, 1000), kUnbounded);
}

TEST(TriggerTable, CellsOutsideSAndKStayMarked) {
  EXPECT_EQ(trigger_of(kOutsideSafe, 2), -2);
  EXPECT_EQ(trigger_of(kOutsideInvariant, 2), -1);
}

}  // namespace
}  // namespace coordreq

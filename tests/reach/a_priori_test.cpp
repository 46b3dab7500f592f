#include "reach/a_priori.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reach/flow_helpers.hpp"

namespace coordreq {
namespace {

struct Found {
  std::optional<FlowFailure> failure;
  std::vector<Interval> box;
  std::vector<Interval> derivative;
};

Found enclose(const FlowCase& known, double duration) {
  const FlowSystem system = known.system();
  const FlowTape tape(system.equations, system.state_slots, system.disturbance_slots);
  VectorField field(system, tape);
  field.begin(known.slots);
  const std::size_t n = system.equations.size();
  Found found{{}, std::vector<Interval>(n), std::vector<Interval>(n)};
  const std::vector<Interval> start(known.slots.begin(),
                                    known.slots.begin() + static_cast<std::ptrdiff_t>(n));
  found.failure = field.enclose_solutions(start, {duration, duration}, found.box, found.derivative);
  return found;
}

TEST(APrioriBox, IsRefusedWhereGrowthOutrunsIt) {
  FlowCase system({"x^2"});
  system.slots[0] = {1.0, 1.0};  // 1 / (1 - t)
  const Found found = enclose(system, 0.9);
  ASSERT_TRUE(found.failure);
  EXPECT_FALSE(found.failure->undefined);
  EXPECT_EQ(found.failure->equation, 0U);
}

TEST(APrioriBox, HoldsTheSolution) {
  FlowCase system({"x^2"});
  system.slots[0] = {1.0, 1.0};
  const Found found = enclose(system, 0.2);
  ASSERT_FALSE(found.failure);
  EXPECT_LE(found.box[0].lower, 1.0);
  EXPECT_GE(found.box[0].upper, 1.25);
  EXPECT_GE(found.derivative[0].upper, 1.5625);
}

TEST(APrioriBox, HoldsSolutionsThatLeaveARestPointWithoutReason) {
  // x' = sqrt(x) stays at 0, or leaves it at any time and comes to t^2 / 4.
  FlowCase system({"sqrt(max(x, 0))"});
  const Found found = enclose(system, 0.1);
  ASSERT_FALSE(found.failure);
  EXPECT_GE(found.box[0].upper, 0.0025);
}

TEST(APrioriBox, EndsAtASideThatIsNeverPassed) {
  FlowCase system({"-x"});
  system.slots[0] = {-1.0, 2.0};
  const Found found = enclose(system, 0.5);
  ASSERT_FALSE(found.failure);
  EXPECT_EQ(found.box[0].lower, -1.0);
  EXPECT_EQ(found.box[0].upper, 2.0);
}

TEST(APrioriBox, GoesBeyondASideThatIsPassedForSomeDisturbance) {
  FlowCase system({"-x + w"});
  system.slots[0] = {-1.0, 2.0};
  system.slots[kDisturbanceSlot] = {-3.0, 0.0};
  const Found found = enclose(system, 0.5);
  ASSERT_FALSE(found.failure);
  EXPECT_LE(found.box[0].lower, -3.0 + 2.0 * std::exp(-0.5));
  EXPECT_EQ(found.box[0].upper, 2.0);
}

TEST(APrioriBox, GoesBeyondACornerThatIsLeftWithoutReason) {
  // On each side alone nothing points out; but x = y = 1 + t^2 / 4 leaves both.
  FlowCase system({"sqrt(max(y - 1, 0)) + min(0, 1 - x)", "sqrt(max(x - 1, 0)) + min(0, 1 - y)"});
  system.slots[0] = system.slots[1] = {0.0, 1.0};
  const Found found = enclose(system, 0.1);
  ASSERT_FALSE(found.failure);
  EXPECT_GE(found.box[0].upper, 1.002);
}

TEST(APrioriBox, SaysWhichEquationIsUndefined) {
  FlowCase system({"1", "sqrt(x - 5)"});
  const Found found = enclose(system, 0.5);
  ASSERT_TRUE(found.failure);
  EXPECT_TRUE(found.failure->undefined);
  EXPECT_EQ(found.failure->equation, 1U);
}

}  // namespace
}  // namespace coordreq

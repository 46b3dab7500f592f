#include "analysis/coarse_copy.hpp"

#include <gtest/gtest.h>

#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

StateSpec state(const Rational& first, const Rational& step, std::int64_t count, const Rational& lower,
                const Rational& upper) {
  return {.name = "x", .grid = {first, step, count}, .lower = lower, .upper = upper};
}

TEST(Regrid, KeepsAPointAndTheDomain) {
  StateSpec x = state(Rational(1, 4), 1, 4, 0, 4);  // 0.25, 1.25, 2.25, 3.25
  regrid(x, Rational(1, 2));
  EXPECT_EQ(x.grid.first, Rational(1, 4));
  EXPECT_EQ(x.grid.step, Rational(1, 2));
  EXPECT_EQ(x.grid.count, 8);  // up to 3.75
  regrid(x, 2);
  EXPECT_EQ(x.grid.first, Rational(1, 4));
  EXPECT_EQ(x.grid.count, 4);
}

TEST(Regrid, FindsNewPointsBelowTheFirst) {
  StateSpec x = state(Rational(3, 4), 1, 4, 0, 4);  // 0.75, 1.75, 2.75, 3.75
  regrid(x, Rational(1, 2));
  EXPECT_EQ(x.grid.first, Rational(1, 4));
  EXPECT_EQ(x.grid.count, 8);
}

TEST(Regrid, KeepsThePeriodOfARing) {
  StateSpec x = state(0, 1, 5, 0, 5);
  x.below = x.above = Outside::periodic;
  regrid(x, Rational(1, 2));
  EXPECT_EQ(x.grid.count, 10);
  EXPECT_EQ(x.grid.step, Rational(1, 2));
  regrid(x, 3);
  EXPECT_EQ(x.grid.count, 3);
  EXPECT_EQ(x.grid.step, Rational(5, 3));
}

TEST(Regrid, LeavesDiscreteStatesAndTheLastTwoPoints) {
  StateSpec x = state(0, 1, 3, 0, 2);
  regrid(x, 5);
  EXPECT_EQ(x.grid.count, 3);
  x.discrete = true;
  regrid(x, Rational(1, 2));
  EXPECT_EQ(x.grid.count, 3);
}

ProblemSpec small_spec(const std::string& more) {
  return read_spec(R"({"coordreq": 1, "name": "small",
    "states": [{"name": "x", "lower": 0, "upper": 100, "step": 1}, {"name": "y", "lower": 0, "upper": 4, "step": 1}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}},
    "safe": "x + y <= 6", "coordination": {"partitions": "all", "horizon": 2, "convention": true},
    "requirements": [{"name": "r", "where": "x <= 1", "invariant": true}])" +
                       more + "}",
                   "test");
}

TEST(CoarseCopy, IsTheSpecWhereThatIsSmall) {
  const std::optional<CoarseCopy> copy = coarse_copy(small_spec(""), 1, 505, 1e6);
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->factor, 1);
  EXPECT_EQ(copy->spec.cells(), 505);
  EXPECT_EQ(copy->spec.coordination.partitions.size(), 1U);
  EXPECT_EQ(copy->spec.coordination.partitions[0].canonical, "a|b");
  EXPECT_EQ(copy->spec.coordination.max_delay, 1);
  EXPECT_FALSE(copy->spec.coordination.convention);
  EXPECT_TRUE(copy->spec.requirements.empty());
}

TEST(CoarseCopy, IsNoCoarserThanItMust) {
  const std::optional<CoarseCopy> copy = coarse_copy(small_spec(""), 0, 504, 1e6);
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->factor, 2);
  EXPECT_EQ(copy->spec.cells(), 51 * 5);  // the few points of y stay
}

TEST(CoarseCopy, IsNotThereWhereNoneIsSmallEnough) {
  EXPECT_FALSE(coarse_copy(small_spec(""), 0, 10, 1e6));
  EXPECT_FALSE(coarse_copy(small_spec(""), 0, 505, 1));
  EXPECT_FALSE(coarse_copy(small_spec(R"(, "controller": {"file": "c.h5"})"), 0, 505, 1e6));
}

}  // namespace
}  // namespace coordreq

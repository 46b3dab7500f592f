// Collision times and delays that 8 or 16 bits do not hold, on chains that lose one cell a step.

#include <gtest/gtest.h>

#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"

namespace coordreq {
namespace {

/// Cells (r, c) in a chain, row by row. A step goes one cell on if `moves`, else it stays; the last cell has
/// none to go on to.
std::string chain(int rows, int length, const std::string& moves, const std::string& max_delay = "null") {
  std::string text = R"json({"coordreq": 1, "name": "chain", "states": [
{"name": "r", "discrete": true, "lower": 0, "upper": LAST_ROW, "step": 1, "outside": "unsafe"},
{"name": "c", "discrete": true, "lower": 0, "upper": LAST_CELL, "step": 1, "outside": "unsafe"}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {
"r": "r + if(MOVES and c >= LAST_CELL, 1, 0)",
"c": "if(MOVES, if(c >= LAST_CELL, 0, c + 1), c)"}},
"safe": "true", "abstraction": {"cells": "half_open"},
"coordination": {"partitions": [{"classes": [["a"], ["b"]]}], "max_delay": MAX_DELAY}})json";
  const auto put = [&](const std::string& name, const std::string& value) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name))
      text.replace(at, name.size(), value);
  };
  put("LAST_ROW", std::to_string(rows - 1));
  put("LAST_CELL", std::to_string(length - 1));
  put("MOVES", moves);
  put("MAX_DELAY", max_delay);
  return text;
}

/// Nothing can be done: cell x of n is lost after n - x steps.
constexpr const char* kAlways = "u + v >= 0";
/// All can stay by doing the same, but without a word the two may go on: cell x of n has delay n - 1 - x.
constexpr const char* kUnlessAlike = "u != v";

/// n, n - 1, ..., n - last.
std::vector<std::int64_t> countdown(std::int64_t n, std::int64_t last) {
  std::vector<std::int64_t> sizes;
  for (std::int64_t k = 0; k <= last; ++k) sizes.push_back(n - k);
  return sizes;
}

void expect_lost_one_by_one(int rows, int length, int threads) {
  ThreadTeam team(threads);
  const FastAnalysis fast(read_spec(chain(rows, length, kAlways), "chain"), team);
  const int n = rows * length;
  EXPECT_EQ(fast.invariance.iterations, n + 1);
  EXPECT_EQ(fast.invariance.invariant.count(), 0);
  std::vector<std::int32_t> expected;
  for (int x = 0; x < n; ++x) expected.push_back(n - x);
  // Not EXPECT_EQ, which would print them all.
  EXPECT_TRUE(fast.collision_times() == expected) << n << " cells, " << threads << " threads";
}

/// @param max_delay negative: none
void expect_delays_one_by_one(int rows, int length, int max_delay, int threads) {
  ThreadTeam team(threads);
  const std::string limit = max_delay < 0 ? "null" : std::to_string(max_delay);
  const FastAnalysis fast(read_spec(chain(rows, length, kUnlessAlike, limit), "chain"), team);
  const int n = rows * length;
  const bool truncated = max_delay >= 0 && max_delay < n;
  EXPECT_EQ(fast.invariance.invariant.count(), n);
  EXPECT_EQ(fast.layers[0].truncated, truncated);
  EXPECT_EQ(fast.layers[0].fixed_point_index, truncated ? -1 : n);
  EXPECT_TRUE(fast.layers[0].sizes == countdown(n, truncated ? max_delay : n));
  std::vector<std::int32_t> expected;
  for (int x = 0; x < n; ++x) expected.push_back(truncated ? std::min(n - 1 - x, max_delay) : n - 1 - x);
  EXPECT_TRUE(fast.delays(0) == expected)
      << n << " cells, max_delay " << limit << ", " << threads << " threads";
}

TEST(WideLevels, CollisionTimesGrowBeyondEightBits) {
  // The greatest finite level of 8 bits is 254.
  for (int n = 252; n <= 258; ++n) expect_lost_one_by_one(1, n, 1);
  expect_lost_one_by_one(700, 1, 1);
  for (const int threads : {1, 2, 5}) expect_lost_one_by_one(26, 10, threads);
}

TEST(WideLevels, DelaysGrowBeyondEightBits) {
  for (int n = 252; n <= 258; ++n) expect_delays_one_by_one(1, n, -1, 1);
  expect_delays_one_by_one(7, 100, -1, 1);
  for (const int threads : {1, 2, 5}) expect_delays_one_by_one(26, 10, -1, threads);
}

TEST(WideLevels, DelaysStopAtAnyMaxDelay) {
  for (int max_delay = 251; max_delay <= 258; ++max_delay) {
    expect_delays_one_by_one(3, 100, max_delay, 1);
    expect_delays_one_by_one(1, 255, max_delay, 1);  // below, at and above the last layer
  }
  expect_delays_one_by_one(3, 100, 0, 1);
  expect_delays_one_by_one(3, 100, 1, 1);
}

TEST(WideLevels, CollisionTimesGrowBeyondSixteenBits) {
  expect_lost_one_by_one(31, 2115, 1);  // 65,565; the greatest finite level of 16 bits is 65,534
}

TEST(WideLevels, DelaysGrowBeyondSixteenBits) {
  expect_delays_one_by_one(31, 2115, 65536, 1);
}

/// Two on a plane, where the minimum over the first dimension is taken once for several rows.
TEST(WideLevels, SlowMotionOnAPlaneEqualsThePlainEngine) {
  for (const std::string max_delay : {"null", "254", "255", "256"}) {
    const ProblemSpec spec = read_spec(R"({"coordreq": 1, "name": "drift", "states": [
{"name": "x", "lower": 0, "upper": 270, "step": 1, "outside": {"below": "unsafe", "above": "saturate"}},
{"name": "y", "lower": 0, "upper": 2, "step": 1, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [-1, 0]}, {"name": "v", "values": [-1, 0, 1]}],
"disturbances": [{"name": "w", "lower": 0, "upper": 1.25}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u + w", "y": "y + v"}},
"safe": "x >= 1 or y >= 1", "abstraction": {"cells": "half_open", "safe": "center"},
"coordination": {"partitions": [{"classes": [["a"], ["b"]]}], "max_delay": )" +
                                           max_delay + "}}",
                                       "drift");
    std::vector<std::int32_t> expected;
    for (const int threads : {1, 2, 5}) {
      ThreadTeam team(threads);
      const FastAnalysis fast(spec, team);
      EXPECT_GT(fast.engine.outer(), 0U);
      if (expected.empty()) {
        const PlainAnalysis plain =
            analyze_plainly(spec, fast.abstraction, members(fast.safe), members(fast.safe));
        expected = plain.partitions[0].delay;
        EXPECT_EQ(plain.partitions[0].truncated, max_delay != "null");
        EXPECT_GT(plain.partitions[0].sizes.size(), 254U);
      }
      EXPECT_TRUE(fast.delays(0) == expected) << "max_delay " << max_delay << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace coordreq

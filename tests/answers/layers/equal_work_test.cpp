// Problems in which work seems equal and is not.

#include <gtest/gtest.h>

#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"
#include "support/plain_engine.hpp"

namespace coordreq {
namespace {

std::vector<bool> as_bits(const CellSet& set) {
  std::vector<bool> result;
  for (std::int64_t x = 0; x < set.cells(); ++x) result.push_back(set.test(x));
  return result;
}

void expect_plain_times_and_delays(const ProblemSpec& spec, const FastAnalysis& fast) {
  const PlainAnalysis plain = analyze_plainly(spec, fast.abstraction, as_bits(fast.safe), as_bits(fast.safe));
  EXPECT_TRUE(fast.collision_times() == plain.collision_time);
  for (std::size_t p = 0; p < plain.partitions.size(); ++p)
    EXPECT_TRUE(fast.delays(p) == plain.partitions[p].delay) << p;
}

/// Rows whose ranges begin at the same cells, and differ in the width of some alone.
TEST(EqualWork, IsNotWhereTheWidthOfARangeDiffers) {
  ThreadTeam team(2);
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "widths",
"states": [{"name": "x", "lower": 0, "upper": 31, "step": 1, "outside": "saturate"},
           {"name": "y", "lower": 0, "upper": 39, "step": 1, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
"disturbances": [{"name": "w", "lower": 0, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1,
             "equations": {"x": "x - 0.05 + if(x >= 15.5 or u >= 1, w, 0)", "y": "y + v"}},
"safe": "x - 3*floor(x/3) <= 1 or y >= 3", "abstraction": {"safe": "center", "cells": "half_open"}})json",
                                     "widths");
  const FastAnalysis fast(spec, team);
  EXPECT_TRUE(fast.answers->context.tiles.has_value());
  EXPECT_EQ(fast.invariance.invariant.count(), 1215);
  expect_plain_times_and_delays(spec, fast);
}

/// Rows that nothing was left to do in have work again where a permuted row of theirs has changed.
TEST(EqualWork, IsNotDoneWhereAPermutedRowHasChanged) {
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "listed",
"states": [{"name": "p0", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
           {"name": "p1", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
           {"name": "p2", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
           {"name": "h", "lower": 0, "upper": 2, "count": 2, "outside": "periodic"},
           {"name": "y", "lower": -7, "upper": 7, "step": 1, "outside": "safe"}],
"inputs": [{"name": "u0", "values": [0, 1]}, {"name": "u1", "values": [0, 1]}, {"name": "u2", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u0"]}, {"name": "b", "inputs": ["u1"]}, {"name": "c", "inputs": ["u2"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {
  "p0": "5 - p0 + u0", "p1": "5 - p1 + u1", "p2": "5 - p2 + u2", "h": "h + 1", "y": "y - h"}},
"safe": "p0 + p1 != 6 and p0 + p2 != 6 and p1 + p2 != 6",
"coordination": {"partitions": [{"classes": [["a"], ["b", "c"]]}, {"classes": [["a"], ["b"], ["c"]]}]},
"abstraction": {"safe": "center", "cells": "half_open"}})json",
                                     "listed");
  ThreadTeam team(2);
  const FastAnalysis fast(spec, team);
  EXPECT_TRUE(fast.actions[1].symmetry.has_value());
  EXPECT_EQ(fast.layers[1].sizes, (std::vector<std::int64_t>{5580, 4260, 240, 0}));
  expect_plain_times_and_delays(spec, fast);
}

}  // namespace
}  // namespace coordreq

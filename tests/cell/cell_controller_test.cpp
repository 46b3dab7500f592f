#include "cell/cell_controller.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "cell/analyzed_file.hpp"
#include "results/scratch_folder.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// What the file says of all cells, by one or the other way.
struct AllActions {
  std::vector<std::vector<bool>> joint;                      ///< [cell]
  std::vector<std::vector<std::vector<bool>>> by_partition;  ///< [partition * cells + cell][class]

  AllActions(const ResultsReader& results, CellController& controller) {
    for (std::int64_t x = 0; x < results.grid().cells(); ++x) joint.push_back(controller.joint_inputs(x));
    for (std::size_t p = 0; p < results.partitions().size(); ++p) {
      for (std::int64_t x = 0; x < results.grid().cells(); ++x) {
        by_partition.push_back(controller.actions(p, x));
      }
    }
  }
};

/// Analyses the spec with and without its actions stored and compares what the two files say of every cell.
/// @param singles how many cells or more are also asked for on their own, before anything was worth computing
///   as a whole
void expect_same_actions(const std::string& spec, ThreadTeam& team, std::int64_t singles = 5) {
  const sample::ScratchFolder folder;
  analyze_into(folder / "all.h5", spec, R"("controller": true, "actions": true)", team);
  analyze_into(folder / "tables.h5", spec, R"("abstraction": true)", team);
  analyze_into(folder / "none.h5", spec, "", team);
  const ResultsReader stored(folder / "all.h5");
  CellController by_file(stored, team);
  const AllActions expected(stored, by_file);
  for (const char* name : {"tables.h5", "none.h5"}) {
    const ResultsReader results(folder / name);
    for (const bool at_once : {false, true}) {
      CellController computed(results, team);
      if (at_once) computed.prepare_all();
      const AllActions found(results, computed);
      ASSERT_EQ(found.joint, expected.joint);
      ASSERT_EQ(found.by_partition, expected.by_partition);
    }
    for (std::int64_t x = 0; x < results.grid().cells(); x += 1 + results.grid().cells() / singles) {
      CellController single(results, team);
      ASSERT_EQ(single.joint_inputs(x), expected.joint[static_cast<std::size_t>(x)]);
    }
  }
}

TEST(CellController, WhatIsComputedIsWhatTheAnalysisStores) {
  ThreadTeam team(1);
  EXPECT_TRUE(
      rc::check("actions of random exact problems", [&] { expect_same_actions(draw_problem(), team); }));
}

TEST(CellController, AlsoWhereSafetyIsAskedForBetweenTheSamples) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("actions of random problems with tubes",
                        [&] { expect_same_actions(draw_problem(RandomTime::between_samples), team); }));
}

// Of a stopped state the half of a boundary cell beyond its limit does not count; of the cells between all
// does.
TEST(CellController, AlsoWhereAStateStops) {
  const char* const spec = R"json({
    "coordreq": 1, "name": "braking",
    "states": [ { "name": "p", "lower": 0, "upper": 8, "step": 0.25 },
                { "name": "v", "lower": 0, "upper": 2, "step": 0.5, "outside": "stop" } ],
    "inputs": [ { "name": "push", "values": [-2, 0, 1] }, { "name": "drag", "values": [0, 0.5] } ],
    "agents": [ { "name": "a", "inputs": ["push"] }, { "name": "b", "inputs": ["drag"] } ],
    "dynamics": { "time": "continuous", "period": 1,
                  "equations": { "p": "v - 1", "v": "push - drag*v^2" } },
    "abstraction": { "between_samples": true },
    "safe": "p + v <= 8" })json";
  ThreadTeam team(1);
  expect_same_actions(spec, team, 60);
}

TEST(CellController, AlsoWherePostsAreRoundedOutward) {
  const char* const spec = R"json({
    "coordreq": 1, "name": "turning",
    "states": [ { "name": "h", "lower": "-pi", "upper": "pi", "count": 12, "outside": "periodic" },
                { "name": "y", "lower": -3, "upper": 3, "step": 0.5, "outside": "safe" },
                { "name": "gear", "lower": 0, "upper": 1, "step": 1, "discrete": true, "outside": "saturate" } ],
    "inputs": [ { "name": "turn", "values": [-1, 0, 1] }, { "name": "shift", "values": [-1, 1] } ],
    "agents": [ { "name": "a", "inputs": ["turn"] }, { "name": "b", "inputs": ["shift"] } ],
    "dynamics": { "time": "discrete", "period": 1,
                  "equations": { "h": "h + turn/2", "y": "y + (1 + gear)*sin(h)", "gear": "gear + shift" } },
    "controller": { "allow": "gear == 0 or turn != 0" },
    "safe": "abs(y) >= 1" })json";
  ThreadTeam team(1);
  expect_same_actions(spec, team, 60);
}

}  // namespace
}  // namespace coordreq

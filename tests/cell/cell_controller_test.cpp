#include "cell/cell_controller.hpp"

#include <gtest/gtest.h>

#include "cell/same_actions.hpp"

namespace coordreq {
namespace {

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

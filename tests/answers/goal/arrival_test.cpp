#include "answers/goal/arrival.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "answers/goal/answer.hpp"
#include "answers/step_codes.hpp"
#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"

namespace coordreq {
namespace {

/// A walk from `last` down to the goal at 0, one cell a step, for whoever wants to and is at most at `first`.
ProblemSpec walk(int last, int first) {
  return read_spec(fmt::format(R"json({{"coordreq": 1, "name": "walk",
"states": [{{"name": "p", "lower": 0, "upper": {}, "step": 1, "discrete": true}}],
"inputs": [{{"name": "u", "values": [0, 1]}}], "agents": [{{"name": "a", "inputs": ["u"]}}],
"dynamics": {{"time": "discrete", "period": 1, "equations": {{"p": "p - if(p <= {}, u, 0)"}}}}, "safe": "true", "goal": "p == 0"}})json",
                               last, first),
                   "walk");
}

/// 253 steps are the last that 8 bits hold.
TEST(Arrival, GrowsBeyondEightBits) {
  ThreadTeam team(1);
  for (const int last : {1, 252, 253, 254, 255, 300}) {
    const FastAnalysis fast(walk(last, last), team);
    const Goal& goal = fast.answers->get<Goal>();
    for (int x = 0; x <= last; ++x) EXPECT_EQ(arrival_at(goal.nearness, x), x) << last;
    EXPECT_EQ(longest_arrival(goal.nearness, team), last);
    EXPECT_EQ(winning_cells(goal.nearness, team).count(), last + 1);
  }
}

TEST(Arrival, IsNeverWhereNobodyCanComeNearer) {
  ThreadTeam team(1);
  const FastAnalysis fast(walk(9, 3), team);
  const Goal& goal = fast.answers->get<Goal>();
  for (int x = 0; x <= 9; ++x) EXPECT_EQ(arrival_at(goal.nearness, x), x <= 3 ? x : kUnbounded);
  EXPECT_EQ(winning_cells(goal.nearness, team).count(), 4);
  EXPECT_EQ(longest_arrival(goal.nearness, team), 3);
}

}  // namespace
}  // namespace coordreq

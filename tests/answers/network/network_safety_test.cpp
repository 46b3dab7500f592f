// Three cells in a row, 0 1 2, and an edge behind the last one. Two agents have a button each. Do both the
// same, the state stays (nobody presses) or goes one cell back (both press); does only one press it, the
// state goes one cell on, from cell 2 over the edge.
//
// All cells can be kept, so K = {0, 1, 2}. C has every joint action in 0 and 1, and in 2 the two in which
// both do the same. An agent that is alone may do either everywhere: it may always be that only one presses.

#include "answers/network/network_safety.hpp"

#include <gtest/gtest.h>

#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"

namespace coordreq {
namespace {

constexpr char kSpec[] = R"json({"coordreq": 1, "name": "edge", "states": [
{"name": "x", "discrete": true, "lower": 0, "upper": 2, "step": 1}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {
"x": "if(u != v, x + 1, if(u == 1, max(x - 1, 0), x))"}},
"safe": "true"})json";

constexpr std::size_t kTogether = 0, kAlone = 1;
using Cells = std::vector<std::int64_t>;

class NetworkOfThreeCells : public testing::Test {
 protected:
  /// The cells of W(q), by mode.
  [[nodiscard]] std::vector<Cells> safe(std::vector<NetworkMode> modes, bool resynthesise) {
    const NetworkProblem problem{
        .controller = &fast_.controller,
        .invariant = &fast_.invariance.invariant,
        .hull = &fast_.hull,
        .partitions = {{whole_class(fast_.abstraction.inputs)}, single_classes(fast_.abstraction.inputs)},
        .rules = {nullptr, nullptr},
        .modes = std::move(modes),
        .resynthesise = resynthesise};
    std::vector<Cells> result;
    for (const CellSet& set : find_network_safety(problem, {}, team_).safe) {
      Cells& cells = result.emplace_back();
      for (std::int64_t x = 0; x < set.cells(); ++x) {
        if (set.test(x)) cells.push_back(x);
      }
    }
    return result;
  }

  ThreadTeam team_{2};
  FastAnalysis fast_{read_spec(kSpec, "edge"), team_};
};

TEST_F(NetworkOfThreeCells, AllCellsCanBeKept) {
  EXPECT_EQ(fast_.invariance.invariant.count(), 3);
}

// Always connected: K.
TEST_F(NetworkOfThreeCells, AConnectionThatStandsKeepsK) {
  for (const bool care : {false, true})
    EXPECT_EQ(safe({{kTogether, {0}}}, care), (std::vector<Cells>{{0, 1, 2}}));
}

// Two lost steps, then a connection for ever. The last lost one may lead one cell on: {0, 1} stay in K. The
// one before must lead into {0, 1}: only 0 does. Care changes nothing: in 1 each alone could
// still do either.
TEST_F(NetworkOfThreeCells, EachLostStepCostsACell) {
  const std::vector<NetworkMode> modes = {{kAlone, {1}}, {kAlone, {2}}, {kTogether, {2}}};
  for (const bool care : {false, true})
    EXPECT_EQ(safe(modes, care), (std::vector<Cells>{{0}, {0, 1}, {0, 1, 2}}));
}

// Never connected: only one may press again and again, so sooner or later the state is over the edge.
TEST_F(NetworkOfThreeCells, WithoutAConnectionNoCellIsSafe) {
  for (const bool care : {false, true}) EXPECT_EQ(safe({{kAlone, {0}}}, care), (std::vector<Cells>{{}}));
}

// Every second step is lost. Without care, connected agents in 1 may go on to 2, where the next step is lost:
// so 1 is not safe while connected, nor is 2, where they may stay. Then 0 is not safe in a lost step, which
// may lead to 1, and so not while connected either, where they may stay in 0 or go to 1.
TEST_F(NetworkOfThreeCells, WithoutCareEverySecondLossIsTooMuch) {
  EXPECT_EQ(safe({{kTogether, {1}}, {kAlone, {0}}}, false), (std::vector<Cells>{{}, {}}));
}

// With care they go back when they are connected, from 2 to 1: a lost step is safe in 0 and 1, a connected
// one everywhere.
TEST_F(NetworkOfThreeCells, WithCareAgentsGoBackWhileTheyAreConnected) {
  EXPECT_EQ(safe({{kTogether, {1}}, {kAlone, {0}}}, true), (std::vector<Cells>{{0, 1, 2}, {0, 1}}));
}

// After a connected step the next one may be lost or not; after a lost one it is not. Then T(connected) is
// what both can tolerate, {0, 1}, and the answer is that of every second one lost.
TEST_F(NetworkOfThreeCells, ALossThatMayComeCountsAsOneThatDoes) {
  EXPECT_EQ(safe({{kTogether, {0, 1}}, {kAlone, {0}}}, true), (std::vector<Cells>{{0, 1, 2}, {0, 1}}));
  EXPECT_EQ(safe({{kTogether, {0, 1}}, {kAlone, {0}}}, false), (std::vector<Cells>{{}, {}}));
}

}  // namespace
}  // namespace coordreq

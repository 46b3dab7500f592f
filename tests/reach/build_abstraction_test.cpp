#include "reach/build_abstraction.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

SystemSpec one_state(const std::string& state, const std::string& equation, const std::string& cells) {
  return read_system(R"({"coordreq": 1, "name": "t", "states": [{"name": "x", )" + state + R"(}],
"inputs": [{"name": "u", "values": [0, 1, 0.5]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": ")" +
                         equation + R"("}},
"safe": "true", "abstraction": {"cells": ")" +
                         cells + R"("}})",
                     "test");
}

Abstraction built_alone(const SystemSpec& spec) {
  ThreadTeam team(1);
  return build_abstraction(spec, team);
}

const std::string kUnitGrid = R"("lower": -5, "upper": 5, "step": 1)";

TEST(BuildAbstraction, ClosedCellsMeetTheNeighboursThatTheyTouch) {
  const Abstraction a = built_alone(one_state(kUnitGrid, "x + u", "closed"));
  EXPECT_EQ(a.raw(0, 5, 0), (IndexRange{4, 6}));
  EXPECT_EQ(a.raw(0, 5, 1), (IndexRange{5, 7}));
  EXPECT_EQ(a.raw(0, 5, 2), (IndexRange{5, 6}));
  EXPECT_EQ(a.raw(0, 0, 0), (IndexRange{-1, 1}));
}

TEST(BuildAbstraction, HalfOpenCellsPartition) {
  const Abstraction a = built_alone(one_state(kUnitGrid, "x + u", "half_open"));
  EXPECT_EQ(a.raw(0, 5, 0), (IndexRange{5, 5}));
  EXPECT_EQ(a.raw(0, 5, 1), (IndexRange{6, 6}));
  EXPECT_EQ(a.raw(0, 5, 2), (IndexRange{5, 6}));
}

TEST(BuildAbstraction, ReflectedHalfOpenCellAttainsItsUpperEnd) {
  // The contract's example: x' = -x maps [-1.5, -0.5) to (0.5, 1.5], which meets [1.5, 2.5).
  const Abstraction a = built_alone(one_state(kUnitGrid, "-x", "half_open"));
  EXPECT_EQ(a.raw(0, 4, 0), (IndexRange{6, 7}));
}

/// Half a turn back: [2.5, 3.5] goes to [-1.75, -1.25], around -2 and -1.
TEST(BuildAbstraction, ARingMayBeTurnedBack) {
  const Abstraction a = built_alone(
      one_state(R"("lower": 0, "upper": 8, "count": 8, "outside": "periodic")", "-x/2", "closed"));
  EXPECT_EQ(a.resolved(0, 3, 0).inside, (IndexRange{6, 7}));
}

TEST(BuildAbstraction, DiscreteStatesMoveFromPointToPoint) {
  const Abstraction a =
      built_alone(one_state(kUnitGrid + R"(, "discrete": true)", "if(u == 1, -x, x^2 - x)", "closed"));
  EXPECT_EQ(a.raw(0, 4, 1), (IndexRange{6, 6}));
  EXPECT_EQ(a.raw(0, 2, 0), (IndexRange{17, 17}));
}

std::string error_of_tables(const SystemSpec& spec) {
  try {
    (void)built_alone(spec);
  } catch (const SpecError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BuildAbstraction, DiscreteStateOffItsGridIsAnErrorThatNamesStateAndInput) {
  EXPECT_EQ(error_of_tables(one_state(kUnitGrid + R"(, "discrete": true)", "x + u", "closed")),
            "the next value of the discrete state 'x' is -4.5 at x = -5, u = 0.5, expected -5 + k * 1 with "
            "an integer k "
            "(/dynamics/equations/x)");
}

TEST(BuildAbstraction, DiscreteStateWithIrrationalValueIsOffItsGrid) {
  EXPECT_NE(
      error_of_tables(one_state(kUnitGrid + R"(, "discrete": true)", "sqrt(x + 5)", "closed")).find("x = -3"),
      std::string::npos);
}

TEST(BuildAbstraction, TablesRangeOverWhatTheEquationUses) {
  const Abstraction a = built_alone(one_state(kUnitGrid, "u", "closed"));
  EXPECT_EQ(a.tables[0].entries.size(), 3U);
  EXPECT_TRUE(a.tables[0].states.empty());
  EXPECT_EQ(a.raw(0, 0, 2), a.raw(0, 10, 2));
}

TEST(BuildAbstraction, OffsetThatDoesNotDependOnTheStateIsStoredOnce) {
  const Abstraction a = built_alone(one_state(kUnitGrid, "x + u", "closed"));
  EXPECT_TRUE(a.tables[0].shift);
  EXPECT_EQ(a.tables[0].states, std::vector<std::int32_t>{0});
  EXPECT_EQ(a.tables[0].state_stride, std::vector<std::int64_t>{0});
  EXPECT_EQ(a.tables[0].entries, (std::vector<IndexRange>{{-1, 1}, {0, 2}, {0, 1}}));
  const TransitionTable full = written_out(a, 0);
  EXPECT_FALSE(full.shift);
  ASSERT_EQ(full.entries.size(), 33U);
  for (std::int64_t x = 0; x < 11; ++x) {
    for (std::int64_t u = 0; u < 3; ++u) {
      EXPECT_EQ(full.entries[static_cast<std::size_t>(3 * x + u)], a.raw(0, x, u));
    }
  }
}

TEST(BuildAbstraction, ShiftsAreSeenBehindConditionsThatDecideNothing) {
  const auto shifts = [](const std::string& state, const std::string& equation) {
    return built_alone(one_state(state, equation, "closed")).tables[0].shift;
  };
  EXPECT_TRUE(shifts(kUnitGrid, "if(u > 0, x + u, x - 1)"));
  EXPECT_TRUE(shifts(kUnitGrid, "min(x, 9) + sin(u)"));
  EXPECT_TRUE(shifts(kUnitGrid, "0.7*x + u^2 - x*(-0.3)"));
  EXPECT_TRUE(shifts(kUnitGrid, "max(x - u, x + u)/2 + x/2"));
  EXPECT_FALSE(shifts(kUnitGrid, "if(x > 0, x + u, x - 1)"));
  EXPECT_FALSE(shifts(kUnitGrid, "min(x, 5) + u"));
  EXPECT_FALSE(shifts(kUnitGrid, "if(u > 0, x, -x)"));
  EXPECT_FALSE(shifts(kUnitGrid, "0.5*x"));
  EXPECT_FALSE(shifts(kUnitGrid, "u"));
  EXPECT_TRUE(shifts(kUnitGrid + R"(, "discrete": true)", "x + 2*u"));
  EXPECT_FALSE(shifts(kUnitGrid + R"(, "discrete": true)", "if(x == 0, 0, x + 2*u)"));
}

TEST(BuildAbstraction, ShiftFarBeyondTheDomainSaturates) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  const Abstraction a = built_alone(one_state(kUnitGrid, "x + 1e12*u", "closed"));
  EXPECT_TRUE(a.tables[0].shift);
  EXPECT_EQ(a.raw(0, 10, 1), (IndexRange{kFar, kFar}));
  EXPECT_TRUE(a.resolved(0, 10, 1).blocked);
}

TEST(BuildAbstraction, RingTurnedByAShiftNeedsNoCutAtItsSeam) {
  // y enters as a number, so that its cell on the seam is cut; the own one goes round whole.
  const SystemSpec spec = read_system(R"({"coordreq": 1, "name": "t",
"states": [{"name": "x", "lower": 0, "upper": 8, "count": 8, "outside": "periodic"},
           {"name": "y", "lower": 0, "upper": 4, "count": 4, "outside": "periodic"}],
"inputs": [{"name": "u", "values": [1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + 0.5*y + u", "y": "y"}},
"safe": "true", "abstraction": {"cells": "half_open"}})",
                                      "test");
  const Abstraction a = built_alone(spec);
  EXPECT_TRUE(a.tables[0].shift);
  // y in [0.5, 1.5) moves x by [1.25, 1.75); on the seam y in [3.5, 4) or [0, 0.5) by [2.75, 3) or [1, 1.25).
  for (std::int64_t x = 0; x < 8; ++x) {
    const auto base = static_cast<std::int32_t>(x);
    EXPECT_EQ(a.raw(0, 4 * x + 1, 0), (IndexRange{base + 1, base + 2}));
    EXPECT_EQ(a.raw(0, 4 * x, 0), (IndexRange{base + 1, base + 3}));
  }
}

TEST(BuildAbstraction, ThreadsDoNotChangeTheTables) {
  const SystemSpec spec = one_state(kUnitGrid, "0.3*x - u", "half_open");
  ThreadTeam one(1);
  ThreadTeam three(3);
  EXPECT_EQ(build_abstraction(spec, one).tables[0].entries, build_abstraction(spec, three).tables[0].entries);
}

}  // namespace
}  // namespace coordreq

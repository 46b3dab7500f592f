#include "abstraction/build_abstraction.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

ProblemSpec one_state(const std::string& state, const std::string& equation, const std::string& cells) {
  return read_spec(R"({"coordreq": 1, "name": "t", "states": [{"name": "x", )" + state + R"(}],
"inputs": [{"name": "u", "values": [0, 1, 0.5]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": ")" +
                       equation + R"("}},
"safe": "true", "abstraction": {"cells": ")" +
                       cells + R"("}})",
                   "test");
}

Abstraction build(const ProblemSpec& spec) {
  ThreadTeam team(1);
  return build_abstraction(spec, team);
}

const std::string kUnitGrid = R"("lower": -5, "upper": 5, "step": 1)";

TEST(BuildAbstraction, ClosedCellsMeetTheNeighboursThatTheyTouch) {
  const Abstraction a = build(one_state(kUnitGrid, "x + u", "closed"));
  EXPECT_EQ(a.raw(0, 5, 0), (IndexRange{4, 6}));
  EXPECT_EQ(a.raw(0, 5, 1), (IndexRange{5, 7}));
  EXPECT_EQ(a.raw(0, 5, 2), (IndexRange{5, 6}));
  EXPECT_EQ(a.raw(0, 0, 0), (IndexRange{-1, 1}));
}

TEST(BuildAbstraction, HalfOpenCellsPartition) {
  const Abstraction a = build(one_state(kUnitGrid, "x + u", "half_open"));
  EXPECT_EQ(a.raw(0, 5, 0), (IndexRange{5, 5}));
  EXPECT_EQ(a.raw(0, 5, 1), (IndexRange{6, 6}));
  EXPECT_EQ(a.raw(0, 5, 2), (IndexRange{5, 6}));
}

TEST(BuildAbstraction, ReflectedHalfOpenCellAttainsItsUpperEnd) {
  // The contract's example: x' = -x maps [-1.5, -0.5) to (0.5, 1.5], which meets [1.5, 2.5).
  const Abstraction a = build(one_state(kUnitGrid, "-x", "half_open"));
  EXPECT_EQ(a.raw(0, 4, 0), (IndexRange{6, 7}));
}

TEST(BuildAbstraction, DiscreteStatesMoveFromPointToPoint) {
  const Abstraction a =
      build(one_state(kUnitGrid + R"(, "discrete": true)", "if(u == 1, -x, x^2 - x)", "closed"));
  EXPECT_EQ(a.raw(0, 4, 1), (IndexRange{6, 6}));
  EXPECT_EQ(a.raw(0, 2, 0), (IndexRange{17, 17}));
}

std::string error_of(const ProblemSpec& spec) {
  try {
    (void)build(spec);
  } catch (const SpecError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BuildAbstraction, DiscreteStateOffItsGridIsAnErrorThatNamesStateAndInput) {
  EXPECT_EQ(error_of(one_state(kUnitGrid + R"(, "discrete": true)", "x + u", "closed")),
            "the next value of the discrete state 'x' is -4.5 at x = -5, u = 0.5, expected -5 + k * 1 with "
            "an integer k "
            "(/dynamics/equations/x)");
}

TEST(BuildAbstraction, DiscreteStateWithIrrationalValueIsOffItsGrid) {
  EXPECT_NE(error_of(one_state(kUnitGrid + R"(, "discrete": true)", "sqrt(x + 5)", "closed")).find("x = -3"),
            std::string::npos);
}

TEST(BuildAbstraction, TablesRangeOverWhatTheEquationUses) {
  const Abstraction a = build(one_state(kUnitGrid, "u", "closed"));
  EXPECT_EQ(a.tables[0].entries.size(), 3U);
  EXPECT_TRUE(a.tables[0].states.empty());
  EXPECT_EQ(a.raw(0, 0, 2), a.raw(0, 10, 2));
}

TEST(BuildAbstraction, ThreadsDoNotChangeTheTables) {
  const ProblemSpec spec = one_state(kUnitGrid, "0.3*x - u", "half_open");
  ThreadTeam one(1);
  ThreadTeam three(3);
  EXPECT_EQ(build_abstraction(spec, one).tables[0].entries, build_abstraction(spec, three).tables[0].entries);
}

}  // namespace
}  // namespace coordreq

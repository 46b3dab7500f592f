// Systems beyond exact ones, with every edge of the domain: the tables are attacked with simulated points.

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "simulated_flow.hpp"

namespace coordreq {
namespace {

using test::build;
using test::spec_text;

/// True if the value lies in the raw range, cells taken as closed; modulo the count where periodic.
bool in_range(const GridDimension& dimension, IndexRange range, double value) {
  const double position = (value - dimension.first.get_d()) / dimension.step.get_d();
  const double slack = 1e-9;  // of the simulation
  for (int turn = dimension.periodic() ? -3 : 0; turn <= (dimension.periodic() ? 3 : 0); ++turn) {
    const double k = position + turn * static_cast<double>(dimension.count);
    if (range.first - 0.5 - slack <= k && k <= range.last + 0.5 + slack) return true;
  }
  return false;
}

/// Points of random cells, on corners and inside, must land in the posts.
void attack(const ProblemSpec& spec, int cases) {
  const Abstraction a = build(spec);
  std::mt19937_64 random(20180410);
  for (int c = 0; c < cases; ++c) {
    const test::RandomStart start = test::random_start(spec, a, random);
    const std::vector<double> next = test::simulate(spec, start.slots).back();
    for (std::size_t i = 0; i < a.grid.size(); ++i) {
      ASSERT_TRUE(in_range(a.grid[i], a.raw(i, start.cell, start.input), next[i]))
          << a.grid[i].name << " = " << next[i] << " from cell " << start.cell << " under input "
          << start.input;
    }
  }
}

const std::string kHeading =
    R"({"name": "h", "lower": "-pi", "upper": "pi", "count": 12, "outside": "periodic"})";
const std::string kPlane =
    R"({"name": "x", "lower": -2, "upper": 2, "step": 0.5}, {"name": "y", "lower": -2, "upper": 2, "step": 0.5})";

TEST(EnclosureTable, UnicycleWithPeriodicHeadingIsEnclosed) {
  attack(read_spec(spec_text(kPlane + ", " + kHeading, "continuous",
                             R"json("x": "cos(h)", "y": "sin(h)", "h": "3*u")json"),
                   "t"),
         2000);
}

TEST(EnclosureTable, ValueThatJumpsAtTheSeamIsEnclosed) {
  // The heading enters as a number, so the two pieces of the cell on the seam lead far apart.
  attack(read_spec(spec_text(R"({"name": "x", "lower": -9, "upper": 9, "step": 0.5}, )" + kHeading,
                             "discrete", R"json("x": "x + 0.7*h + u", "h": "2*h + u")json"),
                   "t"),
         3000);
  attack(read_spec(spec_text(R"({"name": "x", "lower": -9, "upper": 9, "step": 0.5}, )" + kHeading,
                             "discrete", R"json("x": "x + 0.1*h^2", "h": "0.5*h + u")json"),
                   "t"),
         3000);
}

TEST(EnclosureTable, PiecewiseMapsAreEnclosed) {
  attack(
      read_spec(
          spec_text(
              kPlane, "discrete",
              R"json("x": "if(x > 0.2, y - 1, abs(x)*y)", "y": "max(x, y) + sign(y)*u + min(x, 0.3)")json"),
          "t"),
      3000);
}

TEST(EnclosureTable, MeasurementErrorsWidenBeforeAndAfter) {
  const std::string state = R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "measurement_error": 0.25})";
  const Abstraction exact = build(read_spec(spec_text(state, "discrete", R"json("x": "x + u")json"), "t"));
  EXPECT_TRUE(exact.exact);
  // [4.5 - 0.25, 5.5 + 0.25] moves by 0.5 and is widened again: [4.5, 6.5] touches cells 4 and 7.
  EXPECT_EQ(exact.raw(0, 5, 2), (IndexRange{4, 7}));
  EXPECT_EQ(exact.raw(0, 5, 1), (IndexRange{4, 6}));
  // The same by the general route.
  const Abstraction general =
      build(read_spec(spec_text(state, "discrete", R"json("x": "x + sin(u)/sin(1)")json"), "t"));
  EXPECT_FALSE(general.exact);
  EXPECT_EQ(general.raw(0, 5, 1), (IndexRange{4, 6}));
  attack(read_spec(spec_text(state, "continuous", R"json("x": "u - 0.1*x^2")json"), "t"), 500);
}

TEST(EnclosureTable, IntegratorsAreShiftedAlongTheirRow) {
  const Abstraction a =
      build(read_spec(spec_text(kPlane, "continuous", R"json("x": "y^2 + u", "y": "sin(y)")json"), "t"));
  EXPECT_TRUE(a.tables[0].shift);
  EXPECT_EQ(a.tables[0].entries.size(), 9U * 3U);
  EXPECT_FALSE(a.tables[1].shift);
  for (std::int64_t y = 0; y < 9; ++y) {
    for (std::int64_t u = 0; u < 3; ++u) {
      const IndexRange first = a.raw(0, y, u);
      for (std::int64_t x = 1; x < 9; ++x) {
        EXPECT_EQ(a.raw(0, x * 9 + y, u), (IndexRange{static_cast<std::int32_t>(first.first + x),
                                                      static_cast<std::int32_t>(first.last + x)}));
      }
    }
  }
}

TEST(EnclosureTable, DiscreteStatesShiftFromPointToPoint) {
  // sin(0) is not exact in general, so this is the interval route; 0.1 is no double.
  const std::string states = R"({"name": "x", "lower": -2, "upper": 2, "step": 0.5},
{"name": "k", "lower": 0.5, "upper": 4.5, "step": 1, "discrete": true, "outside": "saturate"})";
  const ProblemSpec spec =
      read_spec(spec_text(states, "discrete", R"json("x": "x", "k": "k + 1 + 0*sin(u)")json"), "t");
  const Abstraction a = build(spec);
  EXPECT_TRUE(a.tables[1].shift);
  EXPECT_EQ(a.tables[1].entries, (std::vector<IndexRange>(3, IndexRange{1, 1})));
  EXPECT_EQ(a.raw(1, 3, 0), (IndexRange{4, 4}));
}

TEST(EnclosureTable, VehicleThatBrakesToAStandstillDoesNotReverse) {
  const std::string states =
      R"({"name": "p", "lower": 0, "upper": 9, "step": 0.1}, {"name": "v", "lower": 0, "upper": 2, "step": 0.1, "outside": "stop"})";
  const Abstraction a =
      build(read_spec(spec_text(states, "continuous", R"json("p": "v", "v": "u")json"), "t"));
  // From rest under u = -1 nothing moves: p stays in [4.95, 5.05], which touches the neighbours; v stays 0.
  EXPECT_EQ(a.raw(1, 50 * 21, 0), (IndexRange{0, 0}));
  EXPECT_EQ(a.raw(0, 50 * 21, 0).first, 49);
  EXPECT_EQ(a.raw(0, 50 * 21, 0).last, 51);
}

std::string error_of(const std::string& text) {
  try {
    (void)build(read_spec(text, "t"));
  } catch (const SpecError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EnclosureTable, FiniteEscapeIsAnErrorOrBlocksOutsideTheDomain) {
  const std::string saturated = R"({"name": "x", "lower": -9, "upper": 9, "step": 1, "outside": "saturate"})";
  EXPECT_EQ(error_of(spec_text(saturated, "continuous", R"json("x": "x^2 + u")json")),
            "the solution of 'x' may escape to infinity within one period near x = 2, u = -1 "
            "(/dynamics/equations/x)");
  // With unsafe sides the state has left before it escapes.
  const std::string bounded = R"({"name": "x", "lower": -9, "upper": 9, "step": 1})";
  const Abstraction a = build(read_spec(spec_text(bounded, "continuous", R"json("x": "x^2 + u")json"), "t"));
  EXPECT_TRUE(a.resolved(0, 18, 0).blocked);
  EXPECT_FALSE(a.resolved(0, 9, 1).blocked);
}

TEST(EnclosureTable, UndefinedEquationsNameTheStateAndThePlace) {
  EXPECT_EQ(error_of(spec_text(kPlane, "discrete", R"json("x": "sqrt(x) + u", "y": "y")json")),
            "the equation of 'x' is not defined everywhere near x = -2, u = -1 (/dynamics/equations/x)");
  EXPECT_EQ(error_of(spec_text(kPlane, "discrete", R"json("x": "1/(x*y)", "y": "y")json")).substr(0, 52),
            "the equation of 'x' is not defined everywhere near x");
}

TEST(EnclosureTable, ThreadsDoNotChangeTheTables) {
  const ProblemSpec spec = read_spec(spec_text(kPlane + ", " + kHeading, "continuous",
                                               R"json("x": "cos(h)", "y": "sin(h)", "h": "3*u")json"),
                                     "t");
  ThreadTeam one(1);
  ThreadTeam three(3);
  const Abstraction a = build_abstraction(spec, one);
  const Abstraction b = build_abstraction(spec, three);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.tables[i].entries, b.tables[i].entries);
}

}  // namespace
}  // namespace coordreq

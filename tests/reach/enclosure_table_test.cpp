// Systems beyond exact ones, with every edge of the domain: the tables are attacked with simulated points.

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "reach/attack.hpp"
#include "reach/simulated_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

using test::attack;
using test::build;
using test::spec_text;

const std::string kHeading =
    R"({"name": "h", "lower": "-pi", "upper": "pi", "count": 12, "outside": "periodic"})";
const std::string kPlane =
    R"({"name": "x", "lower": -2, "upper": 2, "step": 0.5}, {"name": "y", "lower": -2, "upper": 2, "step": 0.5})";

TEST(EnclosureTable, UnicycleWithPeriodicHeadingIsEnclosed) {
  attack(read_system(spec_text(kPlane + ", " + kHeading, "continuous",
                               R"json("x": "cos(h)", "y": "sin(h)", "h": "3*u")json"),
                     "t"),
         2000);
}

TEST(EnclosureTable, ValueThatJumpsAtTheSeamIsEnclosed) {
  // The heading enters as a number, so the two pieces of the cell on the seam lead far apart.
  attack(read_system(spec_text(R"({"name": "x", "lower": -9, "upper": 9, "step": 0.5}, )" + kHeading,
                               "discrete", R"json("x": "x + 0.7*h + u", "h": "2*h + u")json"),
                     "t"),
         3000);
  attack(read_system(spec_text(R"({"name": "x", "lower": -9, "upper": 9, "step": 0.5}, )" + kHeading,
                               "discrete", R"json("x": "x + 0.1*h^2", "h": "0.5*h + u")json"),
                     "t"),
         3000);
}

const std::string kRoad = R"({"name": "x", "lower": -9, "upper": 9, "step": 0.125}, )";

TEST(EnclosureTable, HeadingThatIsUsedAsANumberJumpsWithinThePeriod) {
  for (const std::string equations : {
           R"json("x": "h", "h": "3*u")json",
           R"json("x": "h^2 + u*h", "h": "1 + 2*u")json",
           R"json("x": "if(h > 0, 3, -1) + u", "h": "2*u + 0.3*cos(h)")json",
           R"json("x": "h*cos(h) + u", "h": "0.4*h - 1.5")json",
           R"json("x": "sin(h/2)", "h": "3*u")json",
           R"json("x": "h", "h": "-20*u")json",
       }) {
    SCOPED_TRACE(equations);
    attack(read_system(spec_text(kRoad + kHeading, "continuous", equations), "t"), 300);
  }
}

TEST(EnclosureTable, CoupledStatesJumpTogether) {
  const std::string coarse = R"({"name": "x", "lower": -4, "upper": 4, "step": 0.5}, )";
  attack(read_system(spec_text(coarse + kHeading, "continuous",
                               R"json("x": "sin(h/2) - 0.1*x", "h": "3*u + 0.1*x")json"),
                     "t"),
         300);
  const std::string second = R"({"name": "g", "lower": 0, "upper": 0.7, "count": 2, "outside": "periodic"})";
  attack(read_system(spec_text(coarse + kHeading + ", " + second, "continuous",
                               R"json("x": "h*g", "h": "2*u + g", "g": "0.5 + 0.2*sin(h)")json"),
                     "t"),
         300);
}

TEST(EnclosureTable, CellsThatMeetNoSeamKeepTheExactHull) {
  const std::string ring = R"({"name": "h", "lower": -8, "upper": 8, "count": 16, "outside": "periodic"})";
  const Abstraction a = build(read_system(
      spec_text(kRoad + ring, "continuous", R"json("x": "h", "h": "u")json", R"({"cells": "half_open"})"),
      "t"));
  // x in 0 +- 1/16, h in 1 +- 1/2: with u = 1/2 x gets to x + h / 2 + 1/16, in [1/4, 7/8].
  EXPECT_EQ(a.raw(0, 72 * 16 + 9, 2), (IndexRange{72 + 2, 72 + 7}));
}

TEST(EnclosureTable, StateMayWindManyTimes) {
  for (const std::string equations :
       {R"json("x": "h", "h": "100*u")json", R"json("x": "sin(h)", "h": "100*u")json",
        R"json("x": "sin(h) + h", "h": "100*u + cos(h)")json"}) {
    SCOPED_TRACE(equations);
    attack(read_system(spec_text(kRoad + kHeading, "continuous", equations), "t"), 100);
  }
}

TEST(EnclosureTable, PiecewiseMapsAreEnclosed) {
  attack(
      read_system(
          spec_text(
              kPlane, "discrete",
              R"json("x": "if(x > 0.2, y - 1, abs(x)*y)", "y": "max(x, y) + sign(y)*u + min(x, 0.3)")json"),
          "t"),
      3000);
}

TEST(EnclosureTable, MeasurementErrorsWidenBeforeAndAfter) {
  const std::string state = R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "measurement_error": 0.25})";
  const Abstraction exact = build(read_system(spec_text(state, "discrete", R"json("x": "x + u")json"), "t"));
  EXPECT_TRUE(exact.exact);
  // [4.5 - 0.25, 5.5 + 0.25] moves by 0.5 and is widened again: [4.5, 6.5] touches cells 4 and 7.
  EXPECT_EQ(exact.raw(0, 5, 2), (IndexRange{4, 7}));
  EXPECT_EQ(exact.raw(0, 5, 1), (IndexRange{4, 6}));
  // The same by the general route.
  const Abstraction general =
      build(read_system(spec_text(state, "discrete", R"json("x": "x + sin(u)/sin(1)")json"), "t"));
  EXPECT_FALSE(general.exact);
  EXPECT_EQ(general.raw(0, 5, 1), (IndexRange{4, 6}));
  attack(read_system(spec_text(state, "continuous", R"json("x": "u - 0.1*x^2")json"), "t"), 500);
}

TEST(EnclosureTable, SaturatedStatesAreMeasuredAroundTheirGridPoint) {
  const std::string state =
      R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "measurement_error": 1.75, "outside": "saturate"})";
  for (const std::string equation : {"x + 40*u", "x + 40*sin(u)/sin(1)"}) {
    const Abstraction a =
        build(read_system(spec_text(state, "discrete", R"json("x": ")json" + equation + "\""), "t"));
    // All is far below 0 then, so the state is 0, and what is measured is in [-1.75, 1.75].
    EXPECT_EQ(a.resolved(0, 5, 0).inside, (IndexRange{0, 2}));
    EXPECT_EQ(a.resolved(0, 5, 2).inside, (IndexRange{7, 9}));
  }
}

TEST(EnclosureTable, IntegratorsAreShiftedAlongTheirRow) {
  const Abstraction a =
      build(read_system(spec_text(kPlane, "continuous", R"json("x": "y^2 + u", "y": "sin(y)")json"), "t"));
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
  const SystemSpec spec =
      read_system(spec_text(states, "discrete", R"json("x": "x", "k": "k + 1 + 0*sin(u)")json"), "t");
  const Abstraction a = build(spec);
  EXPECT_TRUE(a.tables[1].shift);
  EXPECT_EQ(a.tables[1].entries, (std::vector<IndexRange>(3, IndexRange{1, 1})));
  EXPECT_EQ(a.raw(1, 3, 0), (IndexRange{4, 4}));
}

TEST(EnclosureTable, VehicleThatBrakesToAStandstillDoesNotReverse) {
  const std::string states =
      R"({"name": "p", "lower": 0, "upper": 9, "step": 0.1}, {"name": "v", "lower": 0, "upper": 2, "step": 0.1, "outside": "stop"})";
  const Abstraction a =
      build(read_system(spec_text(states, "continuous", R"json("p": "v", "v": "u")json"), "t"));
  // From rest under u = -1 nothing moves: p stays in [4.95, 5.05], which touches the neighbours; v stays 0.
  EXPECT_EQ(a.raw(1, 50 * 21, 0), (IndexRange{0, 0}));
  EXPECT_EQ(a.raw(0, 50 * 21, 0).first, 49);
  EXPECT_EQ(a.raw(0, 50 * 21, 0).last, 51);
}

std::string error_of(const std::string& text) {
  try {
    (void)build(read_system(text, "t"));
  } catch (const SpecError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EnclosureTable, FiniteEscapeIsAnErrorOrBlocksOutsideTheDomain) {
  const std::string saturated = R"({"name": "x", "lower": -9, "upper": 9, "step": 1, "outside": "saturate"})";
  EXPECT_EQ(
      error_of(spec_text(saturated, "continuous", R"json("x": "x^2 + u")json")),
      "the solution of 'x', with the equation 'x^2 + u', may escape to infinity within one period near x = "
      "2, u = -1, or change too fast to be followed that long (/dynamics/equations/x)");
  // With unsafe sides the state has left before it escapes.
  const std::string bounded = R"({"name": "x", "lower": -9, "upper": 9, "step": 1})";
  const Abstraction a =
      build(read_system(spec_text(bounded, "continuous", R"json("x": "x^2 + u")json"), "t"));
  EXPECT_TRUE(a.resolved(0, 18, 0).blocked);
  EXPECT_FALSE(a.resolved(0, 9, 1).blocked);
}

TEST(EnclosureTable, UndefinedEquationsNameTheStateAndThePlace) {
  EXPECT_EQ(
      error_of(spec_text(kPlane, "discrete", R"json("x": "sqrt(x) + u", "y": "y")json")),
      "the equation of 'x', 'sqrt(x) + u', is not defined everywhere near x = -2, u = -1: square root of a "
      "number in [-2.25, -1.75] (/dynamics/equations/x)");
  EXPECT_EQ(error_of(spec_text(kPlane, "discrete", R"json("x": "1/(x*y)", "y": "y")json")).substr(0, 60),
            "the equation of 'x', '1/(x*y)', is not defined everywhere ne");
  const std::string ring =
      R"({"name": "x", "lower": "-pi", "upper": "pi", "count": 7, "outside": "periodic"})";
  const std::string error = error_of(spec_text(ring, "discrete", R"json("x": "sqrt(x) + u")json"));
  EXPECT_NE(error.find(" near x = -3.14159, u = -1: "), std::string::npos) << error;
}

TEST(EnclosureTable, ThreadsDoNotChangeTheTables) {
  const SystemSpec spec = read_system(spec_text(kPlane + ", " + kHeading, "continuous",
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

// Between the samples: the tubes are attacked with simulated solutions, and compared with what can be worked
// out.

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "reach/simulated_flow.hpp"
#include "reach/table_shapes.hpp"
#include "reach/tables.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

SystemSpec flow(const std::string& states, const std::string& equations,
                const std::string& cells = "closed") {
  return read_system(test::spec_text(states, "continuous", equations,
                                     R"({"between_samples": true, "cells": ")" + cells + "\"}"),
                     "t");
}

/// True if the value lies in a cell of the range, widened by the measurement error; modulo the period.
bool is_covered(const GridDimension& dimension, IndexRange range, double value) {
  const double slack = 1e-9;  // of the simulation
  const double reach = Rational(dimension.radius() + dimension.measurement_error).get_d() + slack;
  const double length = static_cast<double>(dimension.count) * dimension.step.get_d();
  for (int turn = dimension.periodic() ? -3 : 0; turn <= (dimension.periodic() ? 3 : 0); ++turn) {
    const double v = value + turn * length;
    if (dimension.point(range.first).get_d() - reach <= v &&
        v <= dimension.point(range.last).get_d() + reach) {
      return true;
    }
  }
  return false;
}

void attack_tubes(const SystemSpec& spec, int cases) {
  const Abstraction a = test::build(spec);
  std::mt19937_64 random(20180410);
  for (int c = 0; c < cases; ++c) {
    const test::RandomStart start = test::random_start(spec, a, random);
    for (const std::vector<double>& state : test::simulate(spec, start.slots, random)) {
      for (std::size_t i = 0; i < a.grid.size(); ++i) {
        ASSERT_TRUE(is_covered(a.grid[i], a.raw_tube(i, start.cell, start.input), state[i]))
            << a.grid[i].name << " = " << state[i] << " from cell " << start.cell << " under input "
            << start.input;
      }
    }
  }
}

const std::string kLine = R"({"name": "x", "lower": 0, "upper": 9, "step": 0.1})";
const std::string kTubeHeading =
    R"({"name": "h", "lower": "-pi", "upper": "pi", "count": 12, "outside": "periodic"})";
const std::string kTubePlane =
    R"({"name": "x", "lower": -2, "upper": 2, "step": 0.5}, {"name": "y", "lower": -2, "upper": 2, "step": 0.5})";

TEST(Tube, OfAnIntegratorIsExactAndNeedsNoNeighbourThatItJustTouches) {
  for (const std::string cells : {"closed", "half_open"}) {
    const Abstraction a = test::build(flow(kLine, R"json("x": "u")json", cells));
    EXPECT_EQ(a.raw_tube(0, 50, 1), (IndexRange{50, 50}));
    EXPECT_EQ(a.raw_tube(0, 50, 0), (IndexRange{45, 50}));
    EXPECT_EQ(a.raw_tube(0, 50, 2), (IndexRange{50, 53}));  // 0.25 on: two cells and a half
    EXPECT_EQ(a.raw_tube(0, 0, 0), (IndexRange{-5, 0}));
    EXPECT_TRUE(a.resolved_tube(0, 0, 0).blocked);
  }
}

TEST(Tube, MotionInOneDirectionIsExactAndATurnIsCovered) {
  const std::string states = kLine + R"(, {"name": "v", "lower": -2, "upper": 2, "step": 0.1})";
  const Abstraction a = test::build(flow(states, R"json("x": "v", "v": "u")json"));
  EXPECT_TRUE(a.exact);
  const auto cell = [](int x, int v) { return std::int64_t{x} * 41 + v + 20; };
  // v in [0.95, 1.05] slows down to [0.45, 0.55]; x gets 1.05 / 2 - 1 / 8 = 0.4 further.
  EXPECT_EQ(a.raw_tube(0, cell(50, 10), 0), (IndexRange{50, 54}));
  EXPECT_EQ(a.raw_tube(1, cell(50, 10), 0), (IndexRange{25, 30}));
  EXPECT_EQ(a.raw_tube(0, cell(50, -10), 1), (IndexRange{44, 50}));
  // From [0.15, 0.25] it turns: x first gets up to 0.25^2 / 2 = 0.03 further, then back by -0.15 / 2 + 1 / 8
  // = 0.05.
  EXPECT_EQ(a.raw_tube(0, cell(50, 2), 0), (IndexRange{49, 51}));
  EXPECT_EQ(a.raw(0, cell(50, 2), 0).first, 49);
  attack_tubes(flow(states, R"json("x": "v", "v": "u")json"), 300);
}

TEST(Tube, HoldsEverySignalOfTheDisturbance) {
  const std::string text = R"({"coordreq": 1, "name": "t", "states": [)" + kLine +
                           R"(, {"name": "v", "lower": -2, "upper": 2, "step": 0.1}],
"inputs": [{"name": "u", "values": [0]}], "disturbances": [{"name": "w", "lower": -0.2, "upper": 0.4}],
"agents": [{"name": "a", "inputs": ["u"]}], "dynamics": {"time": "continuous", "period": 1,
"equations": {"x": "v - w", "v": "u + w"}}, "safe": "true", "abstraction": {"between_samples": true}})";
  const Abstraction a = test::build(read_system(text, "t"));
  const std::int64_t cell = 50 * 41 + 20;
  EXPECT_EQ(a.raw_tube(1, cell, 0), (IndexRange{-2 + 20, 4 + 20}));
  // What a pulse of w does to x after s is s - 1 < 0, in all -1/2 after a second: x moves by v - w / 2, with
  // |v| <= 0.05, which is -0.25 ... 0.15.
  EXPECT_EQ(a.raw_tube(0, cell, 0), (IndexRange{47, 52}));
}

/// From beyond 710 exp(x) is no double. A solution is enclosed from some cells, where its way has no bound,
/// and not from others: that is an error, and nothing else.
TEST(Tube, AWayWithoutABoundIsAtMostAnError) {
  const SystemSpec spec = read_system(R"json({"coordreq": 1, "name": "t",
"states": [{"name": "x", "lower": -3006, "upper": 2404.8, "count": 9, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [-30, -0.4, 0.2254]}, {"name": "v", "values": [-0.5, 8]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "continuous", "period": 0.01,
"equations": {"x": "-0.3058*(exp(x) - v/1e44) + 0.9666*tan(v + u) + v"}}, "safe": "true",
"abstraction": {"safe": "center", "between_samples": true}})json",
                                      "t");
  EXPECT_THROW(static_cast<void>(test::build(spec)), SpecError);
}

TEST(Tube, RoundingAloneAsksForNoNeighbour) {
  // x only falls, from cells whose faces are no doubles: the upper end of the tube is the exact face.
  const Abstraction falling = test::build(flow(kLine, R"json("x": "if(u > 0, u, u) - 1 - 0.1*x^2")json"));
  // The flow of the heading-free part is positive: x only grows, by a shift.
  const Abstraction growing =
      test::build(flow(kLine + ", " + kTubeHeading, R"json("x": "2 + cos(h)", "h": "u")json"));
  EXPECT_FALSE(falling.exact);
  EXPECT_FALSE(growing.exact);
  for (std::int64_t x = 0; x < 91; ++x) {
    EXPECT_EQ(falling.raw_tube(0, x, 1).last, x);
    EXPECT_LT(falling.raw_tube(0, x, 1).first, x);
    EXPECT_EQ(growing.raw_tube(0, x * 12, 1).first, x);
    EXPECT_GT(growing.raw_tube(0, x * 12, 1).last, x);
  }
}

TEST(Tube, OfAStoppedStateEndsAtItsLimit) {
  const std::string states =
      kLine + R"(, {"name": "v", "lower": 0, "upper": 2, "step": 0.1, "outside": "stop"})";
  const Abstraction a = test::build(flow(states, R"json("x": "v", "v": "u")json"));
  EXPECT_EQ(a.raw_tube(1, 50 * 21, 0), (IndexRange{0, 0}));
  // From [0, 0.05] it rolls on by 0.00125 before it stands, and never back.
  EXPECT_EQ(a.raw_tube(0, 50 * 21, 0), (IndexRange{50, 51}));
  EXPECT_EQ(a.raw_tube(1, 50 * 21 + 20, 2), (IndexRange{20, 20}));
}

TEST(Tube, ThatEndsTellIsNotWiderThanWithAnEnclosure) {
  const std::string states =
      kLine + R"(, {"name": "v", "lower": 0, "upper": 2, "step": 0.1, "outside": "stop"})";
  // x rises, rises from some cells alone, falls.
  for (const std::string motion : {"v", "v - 0.5", "v - 3"}) {
    const SystemSpec spec = flow(states, R"("x": ")" + motion + R"(", "v": "u")", "half_open");
    const AffineDynamics dynamics(spec);
    const Abstraction built = test::build(spec);
    ThreadTeam team(1);
    EXPECT_FALSE(built.exact);
    Abstraction enclosed = built;
    for (std::size_t i = 0; i < 2; ++i) {
      enclosed.tables[i] = {};
      enclosed.tubes[i] = {};
      build_enclosure_tables(spec, dynamics, enclosed, {i}, team);
      EXPECT_EQ(built.tables[i].entries, enclosed.tables[i].entries);
      EXPECT_EQ(built.tubes[i].entries, enclosed.tubes[i].entries);
    }
    EXPECT_EQ(build_affine_table(spec, dynamics, enclosed, 0, team).has_value(), motion != "v - 0.5");
  }
}

TEST(Tube, IsCoveredByCellsAsWideAsTheMeasurementErrorMakesThem) {
  const std::string state = R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "measurement_error": 0.25})";
  for (const std::string equation : {R"json("x": "u")json", R"json("x": "sin(u)/sin(1)")json"}) {
    const Abstraction a = test::build(flow(state, equation));
    // [4.25, 5.75] stays, or moves on by a half at the most: cell 4 covers from 3.25 on.
    EXPECT_EQ(a.raw_tube(0, 5, 1), (IndexRange{5, 5}));
    EXPECT_EQ(a.raw_tube(0, 5, 0), (IndexRange{4, 5}));
  }
  attack_tubes(flow(state, R"json("x": "u - 0.1*x^2")json"), 300);
}

TEST(Tube, GoesRoundTheSeam) {
  const Abstraction a =
      test::build(flow(R"({"name": "h", "lower": 0, "upper": 4, "count": 8, "outside": "periodic"})",
                       R"json("h": "2*u")json"));
  EXPECT_EQ(a.resolved_tube(0, 0, 0).inside, (IndexRange{6, 8}));
  EXPECT_EQ(a.resolved_tube(0, 0, 1).inside, (IndexRange{0, 0}));
  EXPECT_EQ(a.resolved_tube(0, 7, 2).inside, (IndexRange{7, 8}));
}

TEST(Tube, SolutionsStayInIt) {
  attack_tubes(flow(kTubePlane + ", " + kTubeHeading, R"json("x": "cos(h)", "y": "sin(h)", "h": "3*u")json"),
               150);
  attack_tubes(flow(kTubePlane, R"json("x": "y", "y": "u - x - 0.3*y*abs(y)")json"), 150);
  attack_tubes(flow(kTubePlane, R"json("x": "y + u", "y": "-2*x")json"), 150);
  attack_tubes(flow(kTubePlane, R"json("x": "sin(3*x) - u*y", "y": "max(x, u) - y")json"), 150);
  attack_tubes(flow(R"({"name": "x", "lower": -9, "upper": 9, "step": 0.5}, )" + kTubeHeading,
                    R"json("x": "h", "h": "0*u")json"),
               300);
  attack_tubes(flow(R"({"name": "x", "lower": -9, "upper": 9, "step": 0.125}, )" + kTubeHeading,
                    R"json("x": "h", "h": "3*u")json"),
               300);
}

TEST(Tube, OfADiscreteStateIsItsCell) {
  const std::string states =
      R"({"name": "m", "lower": 0, "upper": 2, "step": 1, "discrete": true}, )" + kLine;
  const Abstraction a = test::build(flow(states, R"json("m": "0", "x": "m*u")json"));
  EXPECT_EQ(a.raw_tube(0, 91, 0), (IndexRange{1, 1}));
  EXPECT_EQ(a.raw_tube(1, 2 * 91 + 50, 0), (IndexRange{40, 50}));
  try {
    (void)test::build(flow(states, R"json("m": "2*sign(u)", "x": "u")json"));
    FAIL() << "expected a SpecError";
  } catch (const SpecError& error) {
    EXPECT_STREQ(error.what(),
                 "the discrete state 'm' moves between the samples, where it has no cells, expected the "
                 "equation 0 with 'between_samples' (/dynamics/equations/m)");
  }
}

TEST(Tube, ThereIsNoneUnlessAskedFor) {
  EXPECT_TRUE(test::build(read_system(test::spec_text(kLine, "continuous", R"json("x": "u")json"), "t"))
                  .tubes.empty());
}

/// States that move each other share a flow: each gets the tube that it would have got alone.
TEST(Tube, IsTheSameFromASharedFlow) {
  const std::string coarse =
      R"({"name": "x", "lower": -1, "upper": 1, "step": 1}, {"name": "y", "lower": -1, "upper": 1, "step": 1})";
  const std::string heading =
      R"({"name": "h", "lower": "-pi", "upper": "pi", "count": 4, "outside": "periodic"})";
  const SystemSpec spec = flow(coarse + ", " + heading,
                               R"json("x": "sin(h) - u*y", "y": "cos(h) + x*y + u", "h": "x - 0.3*h")json");
  const AffineDynamics dynamics(spec);
  const Abstraction together = test::build(spec);
  ThreadTeam team(2);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(dynamics.dependencies(i) == dynamics.dependencies(0));
    Abstraction alone = together;
    alone.tables[i] = {};
    alone.tubes[i] = {};
    build_enclosure_tables(spec, dynamics, alone, {i}, team);
    EXPECT_EQ(alone.tables[i].entries, together.tables[i].entries);
    EXPECT_EQ(alone.tubes[i].entries, together.tubes[i].entries);
  }
}

TEST(Tube, NeedsTablesInFullInsteadOfSums) {
  const std::string equations = R"json("x": "y + u", "y": "-2*x")json";
  const Abstraction sums =
      test::build(read_system(test::spec_text(kTubePlane, "continuous", equations), "t"));
  const SystemSpec spec = flow(kTubePlane, equations);
  const Abstraction full = test::build(spec);
  const std::vector<TableShape> shapes = table_shapes(spec);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(sums.tables[i].is_sum());
    EXPECT_FALSE(full.tables[i].is_sum());
    EXPECT_EQ(full.tubes[i].entries.size(), full.tables[i].entries.size());
    EXPECT_FALSE(shapes[i].sum);
    EXPECT_EQ(shapes[i].bytes, static_cast<double>(full.tubes[i].bytes()));
  }
}

TEST(Tube, ThreadsDoNotChangeIt) {
  const SystemSpec spec =
      flow(kTubePlane + ", " + kTubeHeading, R"json("x": "cos(h)", "y": "sin(h)", "h": "3*u")json");
  ThreadTeam one(1);
  ThreadTeam three(3);
  const Abstraction a = build_abstraction(spec, one);
  const Abstraction b = build_abstraction(spec, three);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.tubes[i].entries, b.tubes[i].entries);
}

}  // namespace
}  // namespace coordreq

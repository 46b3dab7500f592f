// The verifier's own tubes against those of the analysis, right ones and others.

#include <gtest/gtest.h>

#include <cmath>

#include "answers/checking/cell_tubes.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "verify/check_tube.hpp"
#include "verify/checks.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/piece_choices.hpp"
#include "verify/safe_beyond.hpp"

namespace coordreq {
namespace {

ProblemSpec problem(const std::string& p, const std::string& v, const std::string& safe = "true",
                    const std::string& outside = "saturate") {
  return read_spec(R"json({"coordreq": 1, "name": "tubes",
"states": [{"name": "p", "lower": 0, "upper": 9, "step": 1, "outside": ")json" +
                       outside + R"json("},
           {"name": "v", "lower": -3, "upper": 3, "step": 1, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [-4, 0, 2]}], "agents": [{"name": "one", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"p": ")json" +
                       p + R"json(", "v": ")json" + v + R"json("}}, "safe": ")json" + safe +
                       R"json(", "abstraction": {"between_samples": true}})json",
                   "tubes");
}

struct Checked {
  ProblemSpec spec;
  Abstraction analysis;
  CheckedTubes tubes;
};

Checked check(ProblemSpec spec) {
  ThreadTeam team(2);
  Abstraction analysis = build_abstraction(spec, team);
  const std::vector<std::uint8_t> safe(static_cast<std::size_t>(analysis.grid.cells()), 1);
  const std::vector<std::int64_t> all;
  AnalysisTables tables(spec, analysis.grid, analysis.inputs, all, team);
  Budget budget(work_of_seconds(60));
  CheckedTubes tubes = check_tubes(spec, analysis.grid, analysis.inputs, tables, safe, budget, team);
  return {std::move(spec), std::move(analysis), std::move(tubes)};
}

std::int64_t doubtful(const CheckedTubes& tubes) {
  std::int64_t sum = 0;
  for (const Finding& finding : tubes.findings) sum += finding.wrong + finding.unproven;
  return sum;
}

using Check = std::optional<TubeFinding> (*)(const PostQuestion&, ThreadTeam&);

std::optional<TubeFinding> check_outward(const PostQuestion& question, ThreadTeam& team) {
  Budget budget(work_of_seconds(60));
  return check_outward_tubes(question, budget, team);
}

std::optional<TubeFinding> check_one(const Checked& checked, std::size_t state, const PostTable& claimed,
                                     Check check_them) {
  ThreadTeam team(2);
  const std::vector<std::int64_t> all;
  const PostQuestion question{.spec = &checked.spec,
                              .grid = &checked.analysis.grid,
                              .inputs = &checked.analysis.inputs,
                              .state = state,
                              .claimed = &claimed,
                              .cells = &all,
                              .check = "tubes"};
  return check_them(question, team);
}

/// Makes each of some entries one cell shorter. @returns how many changes are wrong of how many
std::pair<int, int> wrong_of_shorter(const Checked& checked, std::size_t state, Check check_them) {
  int wrong = 0;
  int all = 0;
  for (std::size_t e = 0; e < checked.tubes.tables[state].entries.size(); e += 3) {
    for (const bool above : {false, true}) {
      PostTable changed = checked.tubes.tables[state];
      IndexRange& range = changed.entries[e];
      if (range.first == range.last) continue;
      (above ? range.last : range.first) += above ? -1 : 1;
      const auto found = check_one(checked, state, changed, check_them);
      ++all;
      if (found && found->finding.wrong == 1) ++wrong;
    }
  }
  return {wrong, all};
}

TEST(CheckTubes, WhatTurnsRoundWithinThePeriodIsCovered) {
  // v changes its sign within the period: p turns round at a parabola's vertex.
  const Checked checked = check(problem("v", "u"));
  EXPECT_EQ(doubtful(checked.tubes), 0);
  EXPECT_TRUE(checked.tubes.borrowed.empty());
  const auto [wrong, all] = wrong_of_shorter(checked, 0, check_corner_tubes);
  EXPECT_GT(wrong, 9 * all / 10);  // but for tubes that are a little longer than they must be
}

TEST(CheckTubes, AStraightWayCouldNotBeShorter) {
  const Checked checked = check(problem("u", "0.5*u"));
  EXPECT_EQ(doubtful(checked.tubes), 0);
  EXPECT_TRUE(checked.tubes.exact);
  const auto [wrong, all] = wrong_of_shorter(checked, 0, check_corner_tubes);
  EXPECT_GT(all, 10);
  EXPECT_EQ(wrong, all);
}

TEST(CheckTubes, AWayThatIsLongerThanItMustBeIsNotExact) {
  Checked checked = check(problem("u", "0.5*u"));
  checked.tubes.tables[0].entries[4].last += 1;
  const auto found = check_one(checked, 0, checked.tubes.tables[0], check_corner_tubes);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.wrong + found->finding.unproven, 0);
  EXPECT_FALSE(found->exact);
}

TEST(CheckTubes, EnclosuresOfDifferentialEquationsHold) {
  for (const char* outside : {"saturate", "unsafe"}) {
    const Checked checked = check(problem("v", "u - 0.5*v", "true", outside));
    EXPECT_EQ(doubtful(checked.tubes), 0) << outside;
    EXPECT_TRUE(checked.tubes.borrowed.empty());
    EXPECT_FALSE(checked.tubes.exact);
    for (const std::size_t state : {0U, 1U}) {
      const auto [wrong, all] = wrong_of_shorter(checked, state, check_outward);
      // The analysis takes the whole period in one step, and what turns round within it for much longer.
      EXPECT_GT(wrong, all / 3) << state << outside;
    }
  }
}

TEST(CheckTubes, AStopHasEnclosuresOfTheVerifiersOwn) {
  // The second moves a speed that a limit stops, in one direction.
  for (const char* p : {"u", "0.25*p + v - 4"}) {
    const Checked stopped = check(problem(p, "u", "true", "stop"));
    EXPECT_TRUE(stopped.tubes.borrowed.empty());
    EXPECT_FALSE(stopped.tubes.exact);
    for (const Finding& finding : stopped.tubes.findings) EXPECT_EQ(finding.wrong, 0) << finding.check;
  }
}

TEST(CheckTubes, OfAStoppedStateNoneCouldBeShorter) {
  const Checked stopped = check(problem("u", "0", "true", "stop"));
  EXPECT_EQ(doubtful(stopped.tubes), 0);
  const auto [wrong, all] = wrong_of_shorter(stopped, 0, check_outward);
  EXPECT_GT(all, 5);
  EXPECT_EQ(wrong, all);
}

TEST(CheckTubes, ALimitIsPassedBehindTheLastCell) {
  const GridDimension dimension{.name = "p",
                                .first = 0,
                                .step = 1,
                                .count = 10,
                                .below = Outside::saturate,
                                .above = Outside::saturate,
                                .lower = 0,
                                .upper = 9};
  EXPECT_FALSE(passes_saturation(dimension, {0, 9}));
  EXPECT_TRUE(passes_saturation(dimension, {0, 10}));
  EXPECT_TRUE(passes_saturation(dimension, {-1, 9}));
}

TEST(CheckTubes, WhatIsSafeBeyondALimitIsChecked) {
  // From 9 with speed 2 it gets as far as 11.5; with speed -4 from 0 to -4.5.
  ThreadTeam team(1);
  const Checked checked = check(problem("u", "0", "p <= 11.4"));
  EXPECT_EQ(doubtful(checked.tubes), 0);
  const std::size_t cells = static_cast<std::size_t>(checked.analysis.grid.cells());
  const std::vector<std::uint8_t> safe(cells, 1);
  EXPECT_EQ(checked.tubes.beyond.back(), 0);
  EXPECT_EQ(checked.tubes.beyond.front(), 1);
  const SafeBeyond beyond(checked.spec, checked.analysis.grid, checked.tubes.tables);
  EXPECT_EQ(beyond.check(safe, checked.tubes.beyond, team).wrong, 0);
  for (const std::size_t cell : {std::size_t{0}, cells / 2, cells - 1}) {
    std::vector<std::uint8_t> changed = checked.tubes.beyond;
    changed[cell] ^= 1U;
    EXPECT_EQ(beyond.check(safe, changed, team).wrong, 1) << cell;
  }
}

struct Bounds {
  double lower;
  double upper;
};

std::optional<FlowRange> range_of(const ProblemSpec& spec, Bounds p, Bounds v, double u, int steps) {
  SpanBox slots(spec.slot_count());
  slots[0] = span_of(exact(p.lower), exact(p.upper));
  slots[1] = span_of(exact(v.lower), exact(v.upper));
  slots[spec.input_slot(0)] = span_of(exact(u), exact(u));
  const Influences influences = influences_on(spec, 0);
  FlowExtremes flow(spec, influences, 1.0);
  return range_during_period(flow, 0, slots, {steps, 1e-10});
}

TEST(FlowRange, OneWayItLiesBetweenItsEnds) {
  const auto range = range_of(problem("-0.5*p", "0"), {1, 2}, {0, 0}, 0, 16);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->lower.approximately(), std::exp(-0.5), 1e-9);
  EXPECT_EQ(range->upper.approximately(), 2.0);
  EXPECT_TRUE(range->stays_below_start);
  EXPECT_FALSE(range->stays_above_start);
  ASSERT_TRUE(range->low);
  EXPECT_NEAR(range->low->approximately(), std::exp(-0.5), 1e-9);
}

TEST(FlowRange, WhatIsDrawnInwardsStaysInside) {
  // p' = 1 - 2 p draws to 1/2 from both sides.
  const auto range = range_of(problem("1 - 2*p", "0"), {0, 1}, {0, 0}, 0, 8);
  ASSERT_TRUE(range);
  EXPECT_TRUE(range->stays_above_start);
  EXPECT_TRUE(range->stays_below_start);
  const auto driven = range_of(problem("2*p - 1", "0"), {0, 1}, {0, 0}, 0, 8);
  ASSERT_TRUE(driven);
  EXPECT_FALSE(driven->stays_above_start);
  EXPECT_FALSE(driven->stays_below_start);
}

TEST(FlowRange, FinerStepsFindWhereItTurns) {
  // p' = v, v' = -4: from v = 2 up by 1/2 after half a period, then back to where it began.
  double last = 2.0;
  for (const int steps : {1, 4, 16, 64}) {
    const auto range = range_of(problem("v + 0*p", "u"), {0, 0}, {2, 2}, -4, steps);
    ASSERT_TRUE(range);
    const double upper = range->upper.approximately();
    EXPECT_GE(upper, 0.5);
    EXPECT_LE(upper, last);
    last = upper;
  }
  EXPECT_NEAR(last, 0.5, 0.03);
}

TEST(CellsNeeded, AFaceThatIsTouchedNeedsNoNeighbour) {
  const GridDimension x{.name = "x", .first = 0, .step = 1, .count = 9};
  const Rational half = Rational(1) / 2;
  EXPECT_EQ(cells_needed(x, 1 - half, 2 + half), (IndexRange{1, 2}));
  EXPECT_EQ(cells_needed(x, half, half), (IndexRange{1, 0}));  // either of two
  EXPECT_EQ(cells_needed(x, half - Rational(1) / 100, 1), (IndexRange{0, 1}));
}

TEST(CellsNeeded, OfWideCellsOneIsEnoughWhicheverItIs) {
  const GridDimension x{.name = "x", .first = 0, .step = 1, .count = 9, .measurement_error = 1};
  const IndexRange needed = cells_needed(x, 2, 2);
  EXPECT_EQ(needed, (IndexRange{3, 1}));
  EXPECT_EQ(TubeBounds::of(needed, needed).outer, (IndexRange{3, 3}));
}

}  // namespace
}  // namespace coordreq

#include "answers/requirements/region.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "expression/condition.hpp"
#include "expression/evaluate.hpp"
#include "model/pieces.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// x and y from 0 to 4 in steps of 1, each side as told; one requirement.
ProblemSpec region(const std::string& where, const std::string& x = R"("outside": "unsafe")",
                   const std::string& y = R"("outside": "unsafe")") {
  std::string text = R"json({"coordreq": 1, "name": "region", "states": [
{"name": "x", "lower": 0, "upper": 4, X},
{"name": "y", "lower": 0, "upper": 4, Y}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}}, "safe": "true",
"requirements": [{"name": "r", "where": "WHERE", "invariant": true}]})json";
  text.replace(text.find("WHERE"), 5, where);
  const auto stepped = [](const std::string& keys) {
    return (keys.find("count") == std::string::npos ? R"("step": 1, )" : "") + keys;
  };
  text.replace(text.find("Y}"), 1, stepped(y));
  text.replace(text.find("X}"), 1, stepped(x));
  return read_spec(text, "region");
}

/// "x below", "" for none.
std::string side(const ProblemSpec& spec) {
  const auto found = side_reached(spec.requirements.front().where, make_grid(spec));
  if (!found) return "";
  return spec.states[found->dimension].name + (found->above ? " above" : " below");
}

constexpr const char* kInside = "1 <= x <= 3 and 1 <= y <= 3";
const std::string kPeriodic = R"("count": 4, "outside": "periodic")";

std::string cells(const ProblemSpec& spec) {
  ThreadTeam team(1);
  const UniformGrid grid = make_grid(spec);
  const CellSet set = cells_of_region(spec.requirements.front().where, grid, team);
  std::string text;
  for (std::int64_t r = 0; r < grid.rows(); ++r) {
    for (std::int64_t k = 0; k < grid.row_length(); ++k) text += (set.row(r)[0] >> k & 1U) != 0 ? '1' : '0';
    text += r + 1 < grid.rows() ? " " : "";
  }
  return text;
}

TEST(RegionOutside, BoundedOnesStayInside) {
  EXPECT_EQ(side(region(kInside)), "");
  EXPECT_EQ(side(region("(x - 2)^2 + (y - 2)^2 <= 4")), "");
  EXPECT_EQ(side(region("abs(x - 2) + abs(y - 2) < 2.5")), "");
  EXPECT_EQ(side(region("max(x, y) <= 4 and min(x, y) >= 0")), "");
  EXPECT_EQ(side(region("false")), "");
}

TEST(RegionOutside, TheFirstSideIsNamed) {
  EXPECT_EQ(side(region("true")), "x below");
  EXPECT_EQ(side(region("x >= 1 and 1 <= y <= 3")), "x above");
  EXPECT_EQ(side(region("1 <= x <= 3")), "y below");
  EXPECT_EQ(side(region("1 <= x <= 3 and y > 1")), "y above");
}

TEST(RegionOutside, TheOuterFaceBelongsToTheOutside) {
  EXPECT_EQ(side(region("1 <= x <= 4.5 and 1 <= y <= 3")), "x above");
  EXPECT_EQ(side(region("1 <= x < 4.5 and 1 <= y <= 3")), "");
  EXPECT_EQ(side(region("1 <= x <= 4.4 and 1 <= y <= 3")), "");
}

/// Faces that are no doubles: y from -1.7 to 0.3 in three points ends at 0.8, and begins at -2.2.
std::string side_of_tenths(const std::string& where, const std::string& x = R"("outside": "unsafe")") {
  ProblemSpec spec = region(where, x);
  spec.states[1].grid = {Rational(-17, 10), 1, 3};
  return side(spec);
}

TEST(RegionOutside, BeginsExactlyAtTheFace) {
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and -2.2 < y < 0.8"), "");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and -2.2 <= y < 0.8"), "y below");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and -2.2 < y <= 0.8"), "y above");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and not (y >= 0.8 or y <= -2.2)"), "");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and 0 < y + 2.2 and 10*y < 8"), "");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and abs(y + 0.7) < 1.5"), "");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and abs(y + 0.7) <= 1.5"), "y below");
  EXPECT_EQ(side_of_tenths("1 <= x <= 3 and (y + 0.7)^2 < 2.25 and y*y*y < 0.512"), "");
  // Whatever x is: it has no bound of its own.
  EXPECT_EQ(side_of_tenths("x^2 <= 9 + y and -2.2 < y < 0.8", R"("outside": "safe")"), "");
}

TEST(RegionOutside, WhatMayBeMeasuredThereCounts) {
  const std::string error = R"("measurement_error": 0.25)";
  EXPECT_EQ(side(region("1 <= x <= 4.3 and 1 <= y <= 3", error)), "x above");
  EXPECT_EQ(side(region("1 <= x <= 4.2 and 1 <= y <= 3", error)), "");
}

TEST(RegionOutside, DiscreteStatesAreAStepAway) {
  const std::string discrete = R"("discrete": true)";
  EXPECT_EQ(side(region("0 <= x <= 4 and 1 <= y <= 3", discrete)), "");
  EXPECT_EQ(side(region("-0.9 <= x <= 4.9 and 1 <= y <= 3", discrete)), "");
  EXPECT_EQ(side(region("0 <= x <= 5 and 1 <= y <= 3", discrete)), "x above");
}

TEST(RegionOutside, OnlyUnsafeSidesCount) {
  for (const std::string rule : {"safe", "saturate"}) {
    EXPECT_EQ(side(region("1 <= y <= 3", R"("outside": ")" + rule + "\"")), "");
    EXPECT_EQ(side(region("1 <= y <= 3", R"("outside": {"above": ")" + rule + "\"}")), "x below");
  }
  EXPECT_EQ(side(region("1 <= y <= 3", kPeriodic)), "");
}

TEST(RegionOutside, OtherStatesAreWhereTheyCanBe) {
  // Beyond y the region needs an x that a limit or a turn does not have, or one beyond a safe side.
  const std::string where = "1 <= y <= 3 or x > 7";
  EXPECT_EQ(side(region(where, R"("outside": "saturate")")), "");
  EXPECT_EQ(side(region(where, kPeriodic)), "");
  EXPECT_EQ(side(region(where, R"("outside": "safe")")), "y below");
}

TEST(RegionOutside, IsCutIntoPartsWhereThatHelps) {
  EXPECT_EQ(side(region("x^2 + y^2 - x*y <= 4 and -9 <= x <= 9 and -9 <= y <= 9")), "x below");
  EXPECT_EQ(side(region("(x - y)^2 + (x - 2)^2 <= 1")), "");
  EXPECT_EQ(side(region("(x - 2)*(y - 2) <= 1 and (x - 2)^2 + (y - 2)^2 <= 4")), "");
}

TEST(RegionOutside, WhatIsNotDefinedThereMayHold) {
  EXPECT_EQ(side(region("sqrt(x) <= 1 and 1 <= y <= 3")), "x below");
  EXPECT_EQ(side(region("sqrt(max(x, 0)) <= 1 and x > 0 and 1 <= y <= 3")), "");
}

TEST(Region, CellsThatTouchItBelongToIt) {
  EXPECT_EQ(cells(region("1.5 <= x <= 2 and 1 <= y <= 2.4")), "00000 01100 01100 00000 00000");
  EXPECT_EQ(cells(region("1.5 < x <= 2 and 1 <= y <= 2.4")), "00000 00000 01100 00000 00000");
  EXPECT_EQ(cells(region("x > 7")), "00000 00000 00000 00000 00000");
}

/// Faces that are no doubles: cells of y are [0.25, 0.35], [0.35, 0.45], ...
TEST(Region, ComparisonsAtFacesAreExact) {
  const auto rows = [](const std::string& where) {
    ProblemSpec spec = region(where);
    spec.states[1].grid = {Rational(3, 10), Rational(1, 10), 5};
    return cells(spec);
  };
  EXPECT_EQ(rows("x < 0.5 and 0.45 < y < 0.55"), "00100 00000 00000 00000 00000");
  EXPECT_EQ(rows("x < 0.5 and 0.45 <= y < 0.55"), "01100 00000 00000 00000 00000");
  EXPECT_EQ(rows("x <= 0.5 and 0.45 < y <= 0.55"), "00110 00110 00000 00000 00000");
  EXPECT_EQ(rows("x < 0.5 and not (y <= 0.45 or 0.55 <= y)"), "00100 00000 00000 00000 00000");
  EXPECT_EQ(rows("x < 0.5 and abs(y - 0.5) < 0.05"), "00100 00000 00000 00000 00000");
  EXPECT_EQ(rows("x < 0.5 and (y - 0.5)*(y - 0.5) < 0.0025"), "00100 00000 00000 00000 00000");
}

TEST(Region, IsWidenedByMeasurementErrors) {
  EXPECT_EQ(cells(region("1.6 <= x <= 2 and 1 <= y <= 1", R"("measurement_error": 0.25)")),
            "00000 01000 01000 00000 00000");
}

TEST(Region, PeriodicCellsAreBothOfTheirPieces) {
  EXPECT_EQ(cells(region("x >= 3.7 and y <= 0", kPeriodic)), "10000 00000 00000 00000");
}

TEST(Region, ACellThatEndsAtTheSeamEndsInFrontOfIt) {
  const std::string error =
      kPeriodic + R"(, "measurement_error": 0.5)";  // cell 3 is [2, 4], and cell 1 [0, 2]
  EXPECT_EQ(cells(region("x <= 0.1 and y <= 0", error)), "10000 10000 00000 00000");
  EXPECT_EQ(cells(region("x >= 3.9 and y <= 0", error)), "10000 00000 00000 10000");
}

int draw(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

std::string random_atom() {
  const char* const names[] = {"x", "y"};
  const char* const operators[] = {"<=", "<", ">=", ">", "==", "!="};
  const std::string a = names[draw(0, 1)], b = names[draw(0, 1)];
  const std::string forms[] = {a,
                               a + "^2 - " + b,
                               a + "*" + b,
                               "abs(" + a + " - " + b + ")",
                               "min(" + a + ", " + b + "^2)",
                               "if(" + a + " > 1, " + b + ", 3 - " + b + ")",
                               "sqrt(" + a + ") - " + b};
  return forms[draw(0, 6)] + " " + operators[draw(0, 5)] + " " + std::to_string(draw(-3, 9));
}

std::string random_condition() {
  std::string where = random_atom();
  for (int k = draw(0, 4); k > 0; --k) {
    where = "(" + where + (draw(0, 3) > 0 ? ") and " : ") or ") + random_atom();
  }
  return where;
}

/// Every cell and every combination of its pieces by itself.
CellSet plain_cells(const Program& where, const UniformGrid& grid) {
  CellSet cells(grid.rows(), grid.row_length());
  ConditionDecider decider(where);
  for (std::int64_t cell = 0; cell < grid.cells(); ++cell) {
    for (const Piece& x : pieces(grid[0], grid.index(cell, 0))) {
      for (const Piece& y : pieces(grid[1], grid.index(cell, 1))) {
        const std::vector<RationalInterval> exact = {{.lower = x.lower, .upper = x.upper},
                                                     {.lower = y.lower, .upper = y.upper}};
        const std::vector<Interval> box = {enclose(exact[0]), enclose(exact[1])};
        const auto exact_box = [&exact]() -> std::span<const RationalInterval> { return exact; };
        if (decider.decide(box, exact_box) != Truth::no) cells.set(cell);
      }
    }
  }
  return cells;
}

TEST(Region, IsFoundInBlocksAsCellByCell) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("cells of a region", [&] {
    const std::string sides[] = {R"("outside": "unsafe")", R"("measurement_error": 0.25)",
                                 R"("outside": "saturate", "discrete": true)", kPeriodic};
    const ProblemSpec spec = region(random_condition(), sides[draw(0, 3)], sides[draw(0, 3)]);
    const Program& where = spec.requirements.front().where;
    const UniformGrid grid = make_grid(spec);
    const CellSet found = cells_of_region(where, grid, team);
    RC_CLASSIFY(found.count() > 0 && found.count() < found.cells(), "some cells");
    RC_ASSERT(found == plain_cells(where, grid));
  }));
}

/// A condition that holds at some point outside is never said to stay inside.
TEST(RegionOutside, ErrsTowardsReaching) {
  EXPECT_TRUE(rc::check("a point outside that is in the region", [&] {
    // Bounded in most cases, for else there is little to be wrong about.
    const std::string where =
        random_condition() + (draw(0, 2) > 0 ? " and abs(x - 2) <= 3 and y < 4.3 and y > x - 3" : "");
    const ProblemSpec spec = region(where);
    const bool stays = side(spec).empty();
    RC_CLASSIFY(stays, "stays inside");
    Evaluator<RationalInterval> exact(spec.requirements.front().where);
    std::vector<RationalInterval> point(spec.slot_count());
    for (int k = 0; stays && k < 200; ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        const Rational value = Rational(draw(-200, 200)) / Rational(draw(1, 20));
        point[i] = {.lower = value, .upper = value};
      }
      const bool outside = point[0].lower < Rational(-1, 2) || point[0].lower > Rational(9, 2) ||
                           point[1].lower < Rational(-1, 2) || point[1].lower > Rational(9, 2);
      if (outside) RC_ASSERT(exact.condition(point) != Truth::yes);
    }
  }));
}

}  // namespace
}  // namespace coordreq

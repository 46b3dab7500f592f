// Tables as sums of one term for each state in which the next value is affine: attacked with simulated
// points, and compared with what comes out cell by cell.

#include "reach/tables.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "reach/attack.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_rows.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

using test::attack;
using test::build;

std::string sum_spec_text(const std::string& states, const std::string& time, const std::string& equations,
                          const std::string& cells = "closed") {
  return R"({"coordreq": 1, "name": "t", "states": [)" + states + R"(],
"inputs": [{"name": "u", "values": [-1, 0, 0.7]}, {"name": "v", "lower": -1, "upper": 1, "step": 0.5}],
"disturbances": [{"name": "w", "lower": -0.25, "upper": 0.5}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": ")" +
         time + R"(", "period": 0.5, "equations": {)" + equations +
         R"(}}, "safe": "true", "abstraction": {"cells": ")" + cells + R"("}})";
}

SystemSpec problem(const std::string& states, const std::string& time, const std::string& equations,
                   const std::string& cells = "closed") {
  return read_system(sum_spec_text(states, time, equations, cells), "t");
}

const std::string kSumPlane =
    R"({"name": "x", "lower": -3, "upper": 3, "step": 1}, {"name": "y", "lower": -2, "upper": 4, "step": 0.7})";
const std::string kSumHeading =
    R"({"name": "h", "lower": "-pi", "upper": "pi", "count": 8, "outside": "periodic"})";
const std::string kAircraft = R"json("x": "-5 + 5*cos(h) + u*y", "y": "5*sin(h) - u*x", "h": "v - u")json";

std::vector<std::size_t> sums(const Abstraction& abstraction) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < abstraction.tables.size(); ++i) {
    if (abstraction.tables[i].is_sum()) result.push_back(i);
  }
  return result;
}

/// The same abstraction with every table that is a sum built cell by cell.
Abstraction cell_by_cell(const SystemSpec& spec, Abstraction abstraction) {
  const AffineDynamics dynamics(spec);
  ThreadTeam team(2);
  for (const std::size_t i : sums(abstraction)) {
    abstraction.tables[i] = {};
    build_enclosure_tables(spec, dynamics, abstraction, {i}, team);
  }
  return abstraction;
}

struct Differences {
  std::int64_t pairs = 0;
  std::int64_t wider = 0;     ///< how often the sum reaches farther
  std::int64_t narrower = 0;  ///< or less far
};

/// A sum may reach farther only where an end lies on a face of a cell up to rounding, so by one cell.
Differences compare(const Abstraction& sum, const Abstraction& plain) {
  Differences result;
  for (const std::size_t i : sums(sum)) {
    for (std::int64_t x = 0; x < sum.grid.cells(); ++x) {
      for (std::int64_t u = 0; u < sum.inputs.count(); ++u, ++result.pairs) {
        const IndexRange a = sum.raw(i, x, u);
        const IndexRange b = plain.raw(i, x, u);
        EXPECT_GE(a.first, b.first - 1) << sum.grid[i].name << " from " << x << " under " << u;
        EXPECT_LE(a.last, b.last + 1) << sum.grid[i].name << " from " << x << " under " << u;
        if (a.first < b.first || a.last > b.last) ++result.wider;
        if (a.first > b.first || a.last < b.last) ++result.narrower;
      }
    }
  }
  return result;
}

/// @param hull whether cell by cell the exact hull comes out, too
void check(const SystemSpec& spec, const std::vector<std::size_t>& expected, bool hull = false) {
  const Abstraction abstraction = build(spec);
  EXPECT_FALSE(abstraction.exact);
  EXPECT_EQ(sums(abstraction), expected);
  attack(spec, abstraction, 500);
  const Differences found = compare(abstraction, cell_by_cell(spec, abstraction));
  EXPECT_GT(found.pairs, 0);
  EXPECT_LE(found.wider, found.pairs / 200);
  if (hull) {
    EXPECT_LE(found.narrower, found.pairs / 50);
  }
}

TEST(SumTable, RotatingFrameWithAHeadingThatMovesOnItsOwn) {
  const SystemSpec spec = problem(kSumPlane + ", " + kSumHeading, "continuous", kAircraft);
  check(spec, {0, 1});
  const Abstraction a = build(spec);
  const TransitionTable& x = a.tables[0];
  ASSERT_EQ(x.terms.size(), 2U);
  EXPECT_EQ(x.base_lower.size(), 8U * 3U * 5U);
  // The matrix depends on one of the inputs.
  EXPECT_EQ(x.terms[0].lower.size(), 7U * 3U);
  EXPECT_EQ(x.terms[1].lower.size(), 8U * 3U);
}

TEST(SumTable, FrictionAndDisturbances) {
  check(problem(kSumPlane, "continuous", R"json("x": "y + w", "y": "u + v - 0.5*y")json"), {0, 1}, true);
  check(problem(kSumPlane, "continuous", R"json("x": "y - x + sin(u)", "y": "u*x - 0.3*y + v*w")json"),
        {0, 1});
}

TEST(SumTable, ShiftWithATermForAnother) {
  // x is a shift whose offset is affine in y; y has friction.
  const SystemSpec spec = problem(kSumPlane, "continuous", R"json("x": "y + v", "y": "u - 0.5*y + w^2")json");
  check(spec, {0, 1});
  const Abstraction a = build(spec);
  EXPECT_TRUE(a.tables[0].shift);
  EXPECT_EQ(a.tables[0].terms.size(), 1U);
}

TEST(SumTable, HalfOpenCells) {
  check(problem(kSumPlane + ", " + kSumHeading, "continuous", kAircraft, "half_open"), {0, 1});
  check(problem(kSumPlane, "continuous", R"json("x": "y + v", "y": "u - 0.5*y + w^2")json", "half_open"),
        {0, 1});
}

TEST(SumTable, MapsOfMixedForm) {
  check(
      problem(kSumPlane + ", " + kSumHeading, "discrete",
              R"json("x": "x + 0.3*y + cos(h)", "y": "if(u > 0, 0.5*x, v*y) + sin(h)*w", "h": "h + u")json"),
      {0, 1});
}

TEST(SumTable, MeasurementErrorsCountBeforeAndAfter) {
  const std::string states =
      R"({"name": "x", "lower": -3, "upper": 3, "step": 0.5, "measurement_error": 0.1},
{"name": "y", "lower": -2, "upper": 4, "step": 0.4, "measurement_error": 0.3})";
  check(problem(states, "continuous", R"json("x": "y + v", "y": "u - 0.5*y + x*v")json"), {0, 1});
  check(problem(states, "continuous", R"json("x": "y + v", "y": "u - 0.5*y")json", "half_open"), {0, 1});
}

TEST(SumTable, MeasurementErrorsByHand) {
  const std::string states =
      R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "measurement_error": 0.25}, {"name": "y", "lower": 0, "upper": 9, "step": 1})";
  const std::string one = "y*sin(1)/sin(1)";  // y, but not exactly
  const Abstraction shift = build(problem(states, "discrete", "\"x\": \"x + " + one + "\", \"y\": \"y\""));
  ASSERT_TRUE(shift.tables[0].is_sum() && shift.tables[0].shift);
  // [5 - 0.75, 5 + 0.75] + [-0.5, 0.5], widened again: [3.5, 6.5] touches cells 3 and 7.
  EXPECT_EQ(shift.raw(0, 50, 0), (IndexRange{3, 7}));
  const Abstraction scaled =
      build(problem(states, "discrete", "\"x\": \"0.5*x + " + one + "\", \"y\": \"y\""));
  ASSERT_TRUE(scaled.tables[0].is_sum() && !scaled.tables[0].shift);
  // 0.5 * [4.25, 5.75] + [-0.5, 0.5], widened: [1.375, 3.625].
  EXPECT_EQ(scaled.raw(0, 50, 0), (IndexRange{1, 4}));
  const std::string coarse =
      R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "measurement_error": 0.4}, {"name": "y", "lower": 0, "upper": 9, "step": 1})";
  const Abstraction doubled =
      build(problem(coarse, "discrete", "\"x\": \"2*x + " + one + "\", \"y\": \"y\""));
  ASSERT_TRUE(doubled.tables[0].is_sum() && !doubled.tables[0].shift);
  // 2 * [1.1, 2.9] + [-0.5, 0.5], widened: [1.3, 6.7]; without the error before it would be [2.1, 5.9].
  EXPECT_EQ(doubled.raw(0, 20, 0), (IndexRange{1, 7}));
}

/// y + z + 1/2 of cells around 0: [-1/2, 3/2], both ends on a face.
TEST(SumTable, ClosedCellsMeetWhatTheyTouch) {
  const std::string states =
      R"({"name": "x", "lower": 0, "upper": 9, "step": 1}, {"name": "y", "lower": 0, "upper": 3, "step": 1}, {"name": "z", "lower": 0, "upper": 3, "step": 1})";
  const Abstraction a =
      build(problem(states, "discrete", R"json("x": "y*cos(u) + z*cos(u) + 0.5", "y": "y", "z": "z")json"));
  ASSERT_TRUE(a.tables[0].is_sum());
  EXPECT_EQ(a.raw(0, 0, 5), (IndexRange{-1, 2}));  // u = 0
}

/// Two terms of 1/2 + 2^-33 a side: rounded inward, each would be 2^-32 short, and the sum would not reach
/// the face that it reaches.
TEST(SumTable, EndsOfTermsAreRoundedOutward) {
  const std::string states =
      R"({"name": "x", "lower": 0, "upper": 9, "step": 1}, {"name": "y", "lower": 0, "upper": 3, "step": 1}, {"name": "z", "lower": 0, "upper": 3, "step": 1})";
  const auto first_cell = [&](const std::string& rest) {
    const Abstraction a = build(problem(states, "discrete",
                                        R"json("x": "(1 + 2^-32)*y*cos(u) + (1 + 2^-32)*z*cos(u) )json" +
                                            rest + R"json(", "y": "y", "z": "z")json"));
    EXPECT_TRUE(a.tables[0].is_sum());
    return a.raw(0, 0, 5);  // u = 0
  };
  EXPECT_EQ(first_cell("+ 0.5 - 2^-32").last, 2);
  EXPECT_EQ(first_cell("- 0.5 + 2^-32").first, -2);
}

TEST(SumTable, SourcesWithPointCells) {
  const std::string states =
      R"({"name": "x", "lower": -3, "upper": 3, "step": 0.5}, {"name": "k", "lower": 1, "upper": 3, "step": 1, "discrete": true})";
  check(problem(states, "continuous", R"json("x": "-k*x + u", "k": "0")json"), {0});
}

TEST(SumTable, OtherFormsWhereASumCannotSayIt) {
  const auto none = [](const std::string& states, const std::string& equations) {
    return sums(build(problem(states, "continuous", equations))).empty();
  };
  // Coefficients that move, limits, a state that is periodic; integrators and shifts are exact or stored
  // once.
  EXPECT_TRUE(none(kSumPlane + ", " + kSumHeading, R"json("x": "h*y", "y": "-x", "h": "v")json"));
  EXPECT_TRUE(none(kSumPlane, R"json("x": "w*y", "y": "-x")json"));
  EXPECT_TRUE(none(kSumPlane, R"json("x": "abs(y)", "y": "-x")json"));
  EXPECT_TRUE(none(R"({"name": "x", "lower": -3, "upper": 3, "step": 0.5, "outside": "stop"})",
                   R"json("x": "u - x")json"));
  EXPECT_TRUE(none(kSumHeading, R"json("h": "v - 0.1*h")json"));
  EXPECT_TRUE(none(kSumPlane, R"json("x": "y", "y": "u + w")json"));
  EXPECT_TRUE(none(kSumPlane, R"json("x": "cos(u)", "y": "sin(u)")json"));
}

TEST(SumTable, FarOutTheTableIsInFull) {
  const Abstraction a =
      build(problem(kSumPlane, "continuous", R"json("x": "60*x + y", "y": "-30*y + u")json"));
  EXPECT_TRUE(sums(a).size() < 2);
}

/// A random equation, affine in `linear` with coefficients in u, v, plus anything in `other`.
std::string random_equation(const std::vector<std::string>& linear, const std::vector<std::string>& other) {
  const auto pick = [](std::initializer_list<const char*> choices) {
    return std::string(*(choices.begin() + *rc::gen::inRange<std::size_t>(0, choices.size())));
  };
  std::string text = pick({"0", "u", "v - u", "0.3*w", "w*u"});
  for (const std::string& name : linear) {
    text +=
        pick({" + 0*", " + ", " - 0.5*", " + u*", " - v*", " + cos(u)*", " + if(v > 0, 1, 0.25)*"}) + name;
  }
  for (const std::string& name : other) text += pick({" + cos(", " - sin(", " + w*sin("}) + name + ")";
  return text;
}

TEST(SumTable, RandomSystemsStayInTheirPosts) {
  EXPECT_TRUE(rc::check("random sums", [] {
    const bool heading = *rc::gen::arbitrary<bool>();
    const std::string time = *rc::gen::element<std::string>("continuous", "discrete");
    const std::string cells = *rc::gen::element<std::string>("closed", "half_open");
    const std::vector<std::string> other =
        heading ? std::vector<std::string>{"h"} : std::vector<std::string>{};
    std::string equations = "\"x\": \"" + random_equation({"x", "y"}, other) + "\", \"y\": \"" +
                            random_equation({"x", "y"}, other) + "\"";
    if (heading) equations += ", \"h\": \"" + random_equation({}, {"h"}) + "\"";
    RC_LOG(equations);
    const SystemSpec spec =
        problem(heading ? kSumPlane + ", " + kSumHeading : kSumPlane, time, equations, cells);
    const Abstraction abstraction = build(spec);
    RC_CLASSIFY(!sums(abstraction).empty(), "a sum");
    attack(spec, abstraction, 40);
    RC_ASSERT(!testing::Test::HasFailure());
  }));
}

/// Every row along every dimension, read at once and pair by pair.
void expect_rows_equal_pairs(const Abstraction& a) {
  for (std::size_t along = 0; along < a.grid.size(); ++along) {
    for (std::size_t i = 0; i < a.tables.size(); ++i) {
      const TableRows rows(a.tables[i], i, along);
      std::vector<IndexRange> row(static_cast<std::size_t>(a.grid[along].count));
      std::vector<std::int64_t> states(a.grid.size());
      std::vector<std::int64_t> inputs(a.inputs.size());
      for (std::int64_t x = 0; x < a.grid.cells(); ++x) {
        if (a.grid.index(x, along) != 0) continue;
        for (std::size_t s = 0; s < states.size(); ++s) states[s] = a.grid.index(x, s);
        states[along] = -7;  // must not matter
        for (std::int64_t u = 0; u < a.inputs.count(); ++u) {
          for (std::size_t s = 0; s < inputs.size(); ++s) inputs[s] = a.inputs.index(u, s);
          rows.read(states, inputs, row);
          for (std::size_t c = 0; c < row.size(); ++c) {
            const auto cell = static_cast<std::int64_t>(c);
            ASSERT_EQ(row[c], a.raw(i, x + cell * a.grid.stride(along), u));
            if (rows.is_constant()) {
              ASSERT_EQ(row[c], row[0]);
            }
            if (rows.is_shift()) {
              ASSERT_EQ(row[c], moved(row[0], cell));
            }
          }
        }
      }
    }
  }
}

TEST(TableRows, EveryFormOfTableAlongEveryDimension) {
  // Sums and a shift; a shift that is a sum; exact ones in full.
  expect_rows_equal_pairs(build(problem(kSumPlane + ", " + kSumHeading, "continuous", kAircraft)));
  expect_rows_equal_pairs(
      build(problem(kSumPlane, "continuous", R"json("x": "y + v", "y": "u - 0.5*y + w^2")json")));
  expect_rows_equal_pairs(
      build(problem(kSumPlane, "discrete", R"json("x": "x - y + u", "y": "v*y + u")json")));
  const std::string states =
      R"({"name": "k", "lower": 1, "upper": 3, "step": 1, "discrete": true}, {"name": "x", "lower": -3, "upper": 3, "step": 0.5})";
  expect_rows_equal_pairs(build(problem(states, "continuous", R"json("x": "-k*x + u", "k": "0")json")));
}

TEST(TableRows, ConstantAndShiftedRowsSayNoMoreThanOneRange) {
  const Abstraction a =
      build(problem(kSumPlane, "continuous", R"json("x": "y + v", "y": "u - 0.5*y + w^2")json"));
  EXPECT_TRUE(TableRows(a.tables[0], 0, 0).is_shift());
  EXPECT_FALSE(TableRows(a.tables[0], 0, 1).is_constant());
  EXPECT_FALSE(TableRows(a.tables[0], 0, 1).is_shift());
  EXPECT_TRUE(TableRows(a.tables[1], 1, 0).is_constant());
}

}  // namespace
}  // namespace coordreq

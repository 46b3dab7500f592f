// The order in which the engine holds the states is nobody's business but its own.

#include "model/model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>

#include "model/cell_order.hpp"
#include "model/row_sample.hpp"
#include "reach/table_shapes.hpp"
#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

std::vector<std::size_t> draw_order(std::size_t size) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
  return order;
}

/// Values of an engine's cells, in the order of the spec.
std::vector<std::int32_t> in_spec_order(const std::vector<std::int32_t>& values, const UniformGrid& grid) {
  std::vector<std::int32_t> result;
  CellOrder(grid).for_each_run(0, grid.cells(), [&](const CellOrder::Run& run) {
    for (std::int64_t i = 0; i < run.count; ++i) {
      const std::int64_t row = run.row + i * run.row_step;
      const std::int64_t column = run.column + i * run.column_step;
      result.push_back(values[static_cast<std::size_t>(row * grid.row_length() + column)]);
    }
  });
  return result;
}

TEST(Layout, AnyOrderOfTheStatesGivesTheSameResults) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("laid out otherwise", [&] {
    const RandomTime time = *rc::gen::element(RandomTime::any, RandomTime::between_samples);
    const ProblemSpec spec = read_spec(draw_problem(time), "random");
    const std::vector<std::size_t> order = draw_order(spec.states.size());
    RC_CLASSIFY(!std::is_sorted(order.begin(), order.end()), "another order");
    const FastAnalysis natural(spec, team);
    const FastAnalysis other(spec, arranged(build_abstraction(spec, team), order), team);
    const UniformGrid& grid = other.abstraction.grid;
    RC_ASSERT(in_spec_order(other.collision_times(), grid) == natural.collision_times());
    for (std::size_t p = 0; p < natural.layers.size(); ++p) {
      RC_ASSERT(in_spec_order(other.delays(p), grid) == natural.delays(p));
    }
  }));
}

ProblemSpec four_states(const std::string& equations, const std::string& output = "{}") {
  return read_spec(R"json({"coordreq": 1, "name": "t", "states": [
{"name": "a", "lower": 0, "upper": 9, "step": 1}, {"name": "b", "lower": 0, "upper": 5, "step": 1},
{"name": "c", "lower": 0, "upper": 9, "step": 1}, {"name": "d", "lower": 0, "upper": 7, "step": 1}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "all", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {)json" +
                       equations + R"(}}, "safe": "true", "output": )" + output + "}",
                   "test");
}

std::vector<std::size_t> order_of(const ProblemSpec& spec) {
  return choose_order(spec, table_shapes(spec)).states;
}

TEST(Layout, RowsRunAlongTheLongestShiftAndWhatMovesWithItComesLast) {
  // a is a shift by b; c and d move by themselves, d is a shift too, but a shorter one.
  const auto order = order_of(four_states(R"("a": "a + b", "b": "0.5*b + u", "c": "0.5*c", "d": "d + 1")"));
  EXPECT_EQ(order, (std::vector<std::size_t>{2, 3, 1, 0}));
}

TEST(Layout, SumsComeAfterWhatLeadsThemTheLongestLast) {
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "turn",
"states": [{"name": "x", "lower": -10, "upper": 10, "step": 0.5}, {"name": "y", "lower": -9, "upper": 9, "step": 0.5},
           {"name": "h", "lower": 0, "upper": "2*pi", "count": 36, "outside": "periodic"}],
"inputs": [{"name": "u", "lower": -1, "upper": 1, "step": 0.5}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 0.2,
  "equations": {"x": "-5 + 5*cos(h) + u*y", "y": "5*sin(h) - u*x", "h": "u"}},
"safe": "x^2 + y^2 >= 4"})json",
                                     "turn");
  EXPECT_EQ(order_of(spec), (std::vector<std::size_t>{2, 1, 0}));
}

/// Two in a square, as the equations and S say.
ProblemSpec two_in_a_square(const std::string& equations, const std::string& safe,
                            const std::string& more = "") {
  std::string states;
  for (const char* name : {"x1", "y1", "x2", "y2"})
    states += std::string(states.empty() ? "" : ", ") + R"({"name": ")" + name +
              R"(", "lower": 0, "upper": 19, "step": 1})";
  return read_spec(
      R"json({"coordreq": 1, "name": "square", "states": [)json" + states +
          R"json(], "inputs": [{"name": "u", "values": [-1, 1]}, {"name": "v", "values": [-1, 1]}],
"agents": [{"name": "one", "inputs": ["u"]}, {"name": "two", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {)json" +
          equations + R"(}}, "safe": ")" + safe + "\"" + more + "}",
      "square");
}

TEST(Layout, StatesThatOnlyMeetInADifferenceStandOnDifferentSides) {
  const std::string moves = R"("x1": "x1 + u", "y1": "y1 + u", "x2": "x2 + v", "y2": "y2 + v")";
  const std::string apart = "max(abs(x1 - x2), abs(y1 - y2)) >= 5";
  const ProblemSpec spec = two_in_a_square(moves, apart);
  const StateOrder order = choose_order(spec, table_shapes(spec));
  EXPECT_EQ(order.states, (std::vector<std::size_t>{0, 2, 1, 3}));
  EXPECT_EQ(order.most_along, 2U);
  // Where other states meet, others stand side by side.
  EXPECT_EQ(order_of(two_in_a_square(moves, "max(abs(x1 - y1), abs(x2 - y2)) >= 5")),
            (std::vector<std::size_t>{0, 1, 2, 3}));
  // What is asked for is read in rows along one state.
  EXPECT_EQ(order_of(two_in_a_square(moves, apart, R"(, "coordination": {"convention": true})")),
            (std::vector<std::size_t>{0, 1, 2, 3}));
  // The rows of states that others depend on are not taken together.
  EXPECT_EQ(
      order_of(two_in_a_square(R"("x1": "x1 + y1", "y1": "y1 + u", "x2": "x2 + v", "y2": "y2 + v")", apart))
          .back(),
      3U);
}

TEST(Layout, ASampleOfRowsCountsWhatIsDifferent) {
  const std::string moves = R"("x1": "x1 + u", "y1": "y1 + u", "x2": "x2 + v", "y2": "y2 + x1")";
  const ProblemSpec spec = two_in_a_square(moves, "max(abs(x1 - x2), abs(y1 - y2)) >= 5");
  const std::vector<TableShape> shapes = table_shapes(spec);
  const RowSample along_y = sample_rows(spec, shapes, {1, 3});
  EXPECT_EQ(along_y.rows, 400);
  EXPECT_EQ(along_y.lanes, 400);
  EXPECT_EQ(along_y.drawn, 64);
  EXPECT_GT(along_y.different, 10);  // y2 moves by x1, which is across
  EXPECT_EQ(sample_rows(spec, shapes, {1, 3}), along_y);
  const ProblemSpec free =
      two_in_a_square(R"("x1": "x1 + u", "y1": "y1 + u", "x2": "x2 + v", "y2": "y2 + v")",
                      "max(abs(x1 - x2), abs(y1 - y2)) >= 5");
  EXPECT_EQ(sample_rows(free, table_shapes(free), {1, 3}).different, 2);
  EXPECT_EQ(sample_rows(free, table_shapes(free), {0, 1, 2, 3}).rows, 1);
}

TEST(Layout, TheOrderOfTheSpecIsKeptWhereNothingIsGained) {
  const std::string equations = R"("a": "0.5*a", "b": "0.5*b", "c": "c + d", "d": "d + u")";
  EXPECT_EQ(
      order_of(four_states(R"("a": "a", "b": "b", "c": "0.5*c", "d": "0.5*d")", R"({"actions": true})")),
      (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(order_of(four_states(equations)), (std::vector<std::size_t>{0, 1, 3, 2}));
  EXPECT_EQ(order_of(four_states(R"("a": "a + u", "b": "b + u", "c": "c + u", "d": "0.5*d")")),
            (std::vector<std::size_t>{0, 1, 3, 2}));
}

}  // namespace
}  // namespace coordreq

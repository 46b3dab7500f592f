// The order in which the engine holds the states is nobody's business but its own.

#include "model/model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>

#include "model/cell_order.hpp"
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
  return choose_order(spec, table_shapes(spec));
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

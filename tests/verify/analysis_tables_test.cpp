// What is computed for some cells is what is computed for all, and no more than that.

#include "verify/analysis_tables.hpp"

#include <gtest/gtest.h>

#include "support/read_system.hpp"

namespace coordreq {
namespace {

SystemSpec tables_problem(const std::string& p, const std::string& q, const std::string& dynamics,
                          const std::string& more = "") {
  return read_system(R"json({"coordreq": 1, "name": "tables",
"states": [{"name": "p", "lower": 0, "upper": 9, "step": 1, )json" +
                         p + R"json(}, {"name": "q", )json" + q + R"json(}],
"inputs": [{"name": "u", "values": [-4, 0, 2]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "one", "inputs": ["u"]}, {"name": "two", "inputs": ["v"]}],
"dynamics": )json" + dynamics +
                         R"json(, "safe": "true")json" + more + "}",
                     "tables");
}

void expect_subset_of_all(const SystemSpec& spec) {
  ThreadTeam team(2);
  const UniformGrid grid = make_grid(spec);
  const InputSpace inputs = make_input_space(spec);
  const std::vector<std::int64_t> none;
  const std::vector<std::int64_t> some = {0, 13, 20, grid.cells() - 1};
  AnalysisTables all(spec, grid, inputs, none, team);
  AnalysisTables few(spec, grid, inputs, some, team);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const PostTable expected = subset_of(all.posts(i), grid, inputs, some);
    EXPECT_LT(expected.entries.size(), all.posts(i).entries.size());
    EXPECT_EQ(few.posts(i).positions, expected.positions);
    EXPECT_EQ(few.posts(i).entries, expected.entries);
    if (!spec.abstraction.between_samples) continue;
    EXPECT_EQ(few.tubes(i).entries, subset_of(all.tubes(i), grid, inputs, some).entries);
  }
  EXPECT_LT(few.entries_built(), all.entries_built() / 2);
}

const char* const kLine = R"("lower": -3, "upper": 3, "step": 0.5, "outside": "safe")";
const char* const kRing = R"("lower": 0, "upper": 6, "count": 30, "outside": "periodic")";

TEST(AnalysisTables, AFlowAndItsWays) {
  const char* const flow =
      R"json({"time": "continuous", "period": 0.5, "equations": {"p": "q*abs(q) - 0.1*p*v", "q": "u - sin(p)"}})json";
  expect_subset_of_all(tables_problem(R"("outside": "saturate")", kLine, flow,
                                      R"(, "abstraction": {"between_samples": true})"));
}

TEST(AnalysisTables, ARingThatTurnsByItself) {
  const char* const flow =
      R"json({"time": "continuous", "period": 0.5, "equations": {"p": "cos(q) + 0.1*v*p^2", "q": "u + sin(q)"}})json";
  expect_subset_of_all(tables_problem(R"("outside": "unsafe")", kRing, flow));
}

TEST(AnalysisTables, ALimitThatStops) {
  const char* const flow =
      R"json({"time": "continuous", "period": 0.5, "equations": {"p": "q + v", "q": "u - 0.1*q^3"}})json";
  expect_subset_of_all(tables_problem(R"("outside": "stop")", kLine, flow));
}

TEST(AnalysisTables, WhatSaturatesIsSeenElsewhere) {
  const char* const map =
      R"json({"time": "discrete", "period": 1, "equations": {"p": "p^2/9 + u", "q": "q*cos(q) + v"}})json";
  expect_subset_of_all(tables_problem(R"("outside": "saturate", "measurement_error": 1.7)", kLine, map));
}

}  // namespace
}  // namespace coordreq

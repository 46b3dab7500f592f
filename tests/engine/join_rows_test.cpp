#include "engine/join_rows.hpp"

#include <gtest/gtest.h>

#include "reach/build_abstraction.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

/// Rows across which dimensions: two vehicles in a plane, moved as the equations say.
std::size_t across(const std::string& equations, const std::string& abstraction = "{}") {
  ThreadTeam team(1);
  const std::string state = R"(, "lower": 0, "upper": 9, "step": 1})";
  const std::string input = R"(, "lower": 0, "upper": 1, "step": 1})";
  const SystemSpec spec = read_system(
      R"({"coordreq": 1, "name": "rows", "states": [{"name": "a")" + state + R"(, {"name": "b")" + state +
          R"(, {"name": "c")" + state + R"(, {"name": "d")" + state + R"(], "inputs": [{"name": "u")" +
          input + R"(, {"name": "v")" + input +
          R"(], "agents": [{"name": "one", "inputs": ["u"]}, {"name": "two",
          "inputs": ["v"]}], "safe": "a > 0", "abstraction": )" +
          abstraction + R"(, "dynamics": {"time": "discrete", "period": 1, "equations": )" + equations + "}}",
      "test");
  const Abstraction f = build_abstraction(spec, team);
  return join_rows(f).across();
}

TEST(JoinRows, TakesAllThatMoveByOffsetsOfTheirOwn) {
  EXPECT_EQ(across(R"({"a": "a + u", "b": "b", "c": "c + v", "d": "d - v"})"), 1U);
}

TEST(JoinRows, StopsWhereAStateDependsOnAnother) {
  EXPECT_EQ(across(R"({"a": "a + u", "b": "b + u", "c": "c + v", "d": "d + c"})"), 3U);  // d on c
  EXPECT_EQ(across(R"({"a": "a + u", "b": "b + a / 10", "c": "c + v", "d": "d - v"})"),
            1U);                                                                         // across rows only
  EXPECT_EQ(across(R"({"a": "a + d", "b": "b + u", "c": "c + v", "d": "d - v"})"), 3U);  // a on d
}

TEST(JoinRows, StopsWhereAStateDoesNotMoveByOffsets) {
  EXPECT_EQ(across(R"({"a": "a + u", "b": "b", "c": "c / 2", "d": "d - v"})"), 3U);
  EXPECT_EQ(across(R"({"a": "a + u", "b": "b", "c": "c + v", "d": "v"})"), 3U);
}

TEST(JoinRows, LeavesRoomForWhatLiesBeyondEachEnd) {
  // The rows of the last test but for d, which goes one back or stays: closed cells touch their neighbours.
  ThreadTeam team(1);
  const UniformGrid grid({{.name = "a", .first = 0, .step = 1, .count = 4},
                          {.name = "b", .first = 0, .step = 1, .count = 5},
                          {.name = "c", .first = 0, .step = 1, .count = 6}});
  Abstraction f{.grid = grid, .inputs = InputSpace({{"u", {Rational(0), Rational(1)}}})};
  for (std::int32_t t = 0; t < 3; ++t) {
    TransitionTable& table = f.tables.emplace_back();
    table.states = {t};
    table.inputs = {0};
    table.shift = true;
    lay_out(table, static_cast<std::size_t>(t), f.grid, f.inputs);
    table.entries = {{-2, 0}, {0, 1}};
  }
  const UniformGrid rows = join_rows(f);
  EXPECT_EQ(rows.across(), 1U);
  EXPECT_EQ(rows.stride(1), 6 + 3);
  EXPECT_EQ(rows.row_length(), 5 * 9);
}

}  // namespace
}  // namespace coordreq

#include <gtest/gtest.h>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using test::error_of;

nlohmann::json with_memory(const std::string& memory, const std::string& changes = "[]") {
  nlohmann::json spec = test::example();
  spec["memory"] = nlohmann::json::parse(memory);
  return spec.patch(nlohmann::json::parse(changes));
}

/// "name count" of the states that memories keep. As text, for the order of its keys counts.
std::vector<std::string> kept(const std::string& memory, const std::string& safe = "inner") {
  std::string text = test::example_with("/abstraction", "{\"safe\": \"" + safe + "\"}").dump();
  text.insert(1, R"("memory": )" + memory + ",");
  const ProblemSpec spec = read_spec(text, "test");
  std::vector<std::string> names;
  for (std::size_t i = 2; i < spec.states.size(); ++i) {
    EXPECT_TRUE(spec.dynamics.is_kept(i));
    names.push_back(spec.states[i].name + " " + std::to_string(spec.states[i].grid.count));
  }
  return names;
}

using Names = std::vector<std::string>;

TEST(MemoryStates, AreNumberedInTheOrderOfTheText) {
  EXPECT_EQ(kept(R"spec({"m": "once(x1 > 0.1)"})spec"), (Names{"m_past 3"}));
  EXPECT_EQ(kept(R"spec({"m": "once(x1 > 0.1)"})spec", "center"), (Names{"m_past 2"}));
  EXPECT_EQ(kept(R"spec({"m": "once(0.2 <= x1 <= 0.4)"})spec"), (Names{"m_past 3"}));
  EXPECT_EQ(kept(R"spec({"m": "once(0.2 <= x1 <= 0.4)"})spec", "center"), (Names{"m_past 2"}));
  EXPECT_EQ(kept(R"spec({"m": "within(4, x1 > 0.1) or for_last(3, x1 > 0.1)"})spec"),
            (Names{"m_past1 4", "m_past2 4", "m_past3 3", "m_past4 3"}));
  EXPECT_EQ(kept(R"spec({"m": "within(4, previous(x1 > 9))"})spec"), (Names{"m_past1 4", "m_past2 2"}));
  EXPECT_EQ(kept(R"spec({"m": "within(1, x1 > 9)"})spec"), Names{});
  EXPECT_EQ(kept(R"spec({"z": "once(a)", "a": "previous(x1 > 9)"})spec"), (Names{"z_past 2", "a_past 2"}));
}

TEST(MemoryStates, AreWhatARequirementBeginsWith) {
  const nlohmann::json spec = with_memory(
      R"spec({"m": "once(x1 > 9)", "n": "once(x2 > 9)"})spec",
      R"([{"op": "add", "path": "/requirements", "value": [{"name": "r", "where": "not m and x1 < 0", "invariant": true}]}])");
  EXPECT_EQ(test::read(spec).requirements.front().where.variables(), (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(MemoryErrors, AFormulaIsOverStates) {
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "once(u1 > 0)"})spec")),
            "expected an expression over states, found the input 'u1' (/memory/m)");
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "once(d)"})spec",
                                 R"([{"op": "add", "path": "/definitions/d", "value": "u1 > x1"}])")),
            "expected an expression over states, found the input 'u1' (/memory/m)");
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "once(x1)"})spec")),
            "expected a condition, found a number (/memory/m, column 6)");
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "once(x9 > 1)"})spec")),
            "'x9' is not defined, did you mean 'x1'? (/memory/m, column 6)");
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "1 + once(x1 > 1)"})spec")),
            "expected a number, found a condition (/memory/m, column 5)");
}

TEST(MemoryErrors, OperatorsTakeWhatTheyTake) {
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "x1 > 0 and within(x1 > 0)"})spec")),
            "within takes 2 arguments, found 1 (/memory/m, column 12)");
  for (const std::string n : {"0", "1.5", "-1", "x1", "2^40"}) {
    EXPECT_EQ(error_of(with_memory("{\"m\": \"for_last(" + n + ", x1 > 0)\"}")),
              "expected a constant integer from 1 to 2147483646 as the number of samples, found '" + n +
                  "' (/memory/m)");
  }
  EXPECT_EQ(error_of(test::example_with("/safe", "\"once(x1 > 0)\"")),
            "'once' looks at the past, expected it in a formula of 'memory' only (/safe, column 1)");
  for (const std::string text : {"once(x1 > 0", "once(within(2, x1 > 0)"}) {
    EXPECT_EQ(error_of(with_memory("{\"m\": \"" + text + "\"}")),
              "expected ')', found the end (/memory/m, column " + std::to_string(text.size() + 1) + ")");
  }
}

TEST(MemoryErrors, MemoriesHaveNoCycles) {
  EXPECT_EQ(error_of(with_memory(R"spec({"a": "once(b)", "b": "previous(a)"})spec")),
            "cycle of definitions and memories: a -> b -> a (/memory/a)");
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "once(d)"})spec",
                                 R"([{"op": "add", "path": "/definitions/d", "value": "not m"}])")),
            "cycle of definitions and memories: d -> m -> d (/definitions/d)");
}

TEST(MemoryErrors, DynamicsDoNotDependOnThem) {
  const auto change = [](const std::string& path, const std::string& value) {
    return R"x([{"op": "add", "path": "/definitions/d", "value": "if(m, 1, 2)"},
                {"op": "replace", "path": ")x" +
           path + R"x(", "value": ")x" + value + R"x("}])x";
  };
  const std::string memory = R"spec({"m": "once(x1 > 9)"})spec";
  EXPECT_EQ(error_of(with_memory(memory, change("/dynamics/equations/x1", "if(m, u1, 0)"))),
            "expected no memory but in conditions such as 'safe', found 'm' (/dynamics/equations/x1)");
  EXPECT_EQ(
      error_of(with_memory(memory, change("/dynamics/equations/x1", "d*u1"))),
      "expected no memory but in conditions such as 'safe', found 'm' through 'd' (/dynamics/equations/x1)");
  EXPECT_EQ(error_of(with_memory(memory, change("/dynamics/equations/x1", "m_past"))),
            "expected no memory but in conditions such as 'safe', found 'm' through 'm_past' "
            "(/dynamics/equations/x1)");
  EXPECT_EQ(error_of(with_memory(memory, change("/safe", "x1 < d"))), "");
}

TEST(MemoryErrors, NamesAreDifferent) {
  EXPECT_EQ(error_of(with_memory(R"spec({"x1": "once(x2 > 0)"})spec")),
            "the name 'x1' is taken, it stands at /states/0/name too (/memory/x1)");
  EXPECT_EQ(error_of(with_memory(R"spec({"m": "once(x2 > 0)"})spec",
                                 R"([{"op": "add", "path": "/constants/m_past", "value": 1}])")),
            "the name 'm_past' is taken, it stands at /memory/m too (/constants/m_past)");
}

TEST(MemoryErrors, NothingIsRememberedBetweenTheSamples) {
  EXPECT_EQ(
      error_of(with_memory(R"spec({"m": "once(x2 > 0)"})spec",
                           R"([{"op": "add", "path": "/abstraction", "value": {"between_samples": true}}])")),
      "'between_samples' together with 'memory' is not supported yet (/abstraction/between_samples)");
}

}  // namespace
}  // namespace coordreq

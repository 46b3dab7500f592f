#include "expression/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

long count(const Program& program, Operator op) {
  return std::count_if(program.nodes.begin(), program.nodes.end(),
                       [&](const auto& node) { return node.op == op; });
}

TEST(Link, StoresEqualSubexpressionsOnce) {
  const Program program = link_xyz("sin(x + y) * sin(x + y + 0) + sin(x + y)");
  EXPECT_EQ(count(program, Operator::sine), 2);
  EXPECT_EQ(count(link_xyz("(x + y)^3 + sin(x + y) + (x + y) * 0.5"), Operator::add), 3);
}

TEST(Link, EndsWithTheResultAndKeepsNothingElse) {
  const Program program = link_xyz("if(1 < 2, x, sin(y))");
  ASSERT_EQ(program.nodes.size(), 1U);
  EXPECT_EQ(program.nodes[0].op, Operator::variable);
  EXPECT_EQ(program.variables(), std::vector<std::uint32_t>{0});
}

TEST(Link, FoldsExactConstants) {
  for (const char* const text :
       {"2*3", "1/3 + 1/6", "2^10", "sqrt(4)", "cos(0)", "min(1, 2)", "8^(1/3)", "abs(-1)"}) {
    const Program program = link_xyz(text);
    ASSERT_EQ(program.nodes.size(), 1U) << text;
    EXPECT_EQ(program.nodes[0].op, Operator::constant) << text;
  }
  EXPECT_EQ(link_xyz("1/3 + 1/6").constants, std::vector<Rational>{Rational(1, 2)});
}

TEST(Link, KeepsIrrationalAndUndefinedConstantsAsOperations) {
  EXPECT_EQ(count(link_xyz("sin(1) * x"), Operator::sine), 1);
  EXPECT_EQ(count(link_xyz("sqrt(2)"), Operator::square_root), 1);
  EXPECT_EQ(count(link_xyz("1/0"), Operator::divide), 1);
  EXPECT_EQ(count(link_xyz("x + 1/0"), Operator::divide), 1);
  EXPECT_EQ(count(link_xyz("2^10000"), Operator::power), 1);
}

TEST(Link, FoldsConditionsThatAreDecided) {
  EXPECT_EQ(link_xyz("1 < 2").nodes[0].op, Operator::literal_true);
  EXPECT_EQ(link_xyz("not (1 < 2 and 3 == 3)").nodes[0].op, Operator::literal_false);
  EXPECT_EQ(link_xyz("true and x < y").nodes.back().op, Operator::less);
  EXPECT_EQ(link_xyz("x < y or false").nodes.back().op, Operator::less);
  EXPECT_EQ(link_xyz("x < y or true").nodes.size(), 1U);
  EXPECT_EQ(link_xyz("false and 1/x < y").nodes.size(), 1U);
}

TEST(Link, EqualBranchesAreTheBranchWhereTheConditionIsDefined) {
  EXPECT_EQ(link_xyz("if(x > 0, -10, -10)").nodes.back().op, Operator::constant);
  EXPECT_EQ(link_xyz("if(1/(1 + 1)*x^3 < sin(y), x + y, x + y)").nodes.back().op, Operator::add);
  for (const char* const text : {"if(sqrt(x) > 0, y, y)", "if(1/x > 0, y, y)", "if(x^y > 0, z, z)",
                                 "if(not (log(x) > 0), y, y)", "if(x > 0, y, z)"})
    EXPECT_EQ(link_xyz(text).nodes.back().op, Operator::if_else) << text;
}

TEST(Link, KnowsThatBothFactorsAreTheSame) {
  const std::array slots{Interval{-1.0, 2.0}};
  const Program program = link_xyz("x * x");
  const Interval square = Evaluator<Interval>(program).number(slots);
  EXPECT_EQ(square.lower, 0.0);
  EXPECT_EQ(square.upper, 4.0);
}

TEST(Link, ChainSharesItsMiddleOperand) {
  const Program program = link_xyz("0 < sin(x) < 1");
  EXPECT_EQ(count(program, Operator::sine), 1);
  EXPECT_EQ(count(program, Operator::less), 2);
  EXPECT_EQ(count(program, Operator::logical_and), 1);
}

TEST(Link, InlinesConstantsAndDefinitions) {
  const auto definition = std::make_shared<const Program>(link_xyz("x^2 + y^2"));
  const auto inside = std::make_shared<const Program>(link_xyz("x < 1"));
  const Lookup lookup = [&](std::string_view name) -> Binding {
    if (name == "r2") return definition;
    if (name == "inside") return inside;
    if (name == "R") return Rational(4, 5);
    return look_up_xyz(name);
  };
  const Program program =
      link("r2 <= R^2 and inside and x^2 + y^2 < 7", lookup, ExpectedType::condition, "/safe");
  EXPECT_EQ(count(program, Operator::add), 1);
  EXPECT_EQ(program.variables(), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(program.text, "r2 <= R^2 and inside and x^2 + y^2 < 7");
  EXPECT_EQ(error_of([&] { (void)link("1 + inside", lookup, ExpectedType::any, "/safe"); }),
            "expected a number, found a condition (/safe, column 5)");
}

TEST(Link, DefinitionsOverConstantsFoldWhenUsed) {
  const auto half = std::make_shared<const Program>(link_xyz("1/2"));
  const Lookup lookup = [&](std::string_view) -> Binding { return half; };
  EXPECT_EQ(link("half * half", lookup, ExpectedType::number, "").constants,
            std::vector<Rational>{Rational(1, 4)});
}

TEST(Link, NeverLooksUpReservedNames) {
  const Lookup lookup = [](std::string_view name) -> Binding {
    ADD_FAILURE() << "looked up " << name;
    return NotDefined{};
  };
  EXPECT_EQ(link("sin(pi) + if(true and not false, 1, 0)", lookup, ExpectedType::number, "").nodes.empty(),
            false);
}

TEST(Program, VariablesAreAscendingAndUnique) {
  EXPECT_EQ(link_xyz("z + x*z - x").variables(), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_TRUE(link_xyz("1 + pi").variables().empty());
}

TEST(MentionedNames, AreInOrderOfAppearanceWithoutReservedOnes) {
  EXPECT_EQ(mentioned_names("b + sin(a) * b < pi and c", ""), (std::vector<std::string>{"b", "a", "c"}));
  EXPECT_TRUE(mentioned_names("1 + 2 < pi or true", "").empty());
}

TEST(ReservedName, CoversFunctionsAndKeywords) {
  for (const char* const name : {"sin", "cos",   "tan",   "asin", "acos", "atan", "sinh", "cosh", "tanh",
                                 "exp", "log",   "sqrt",  "abs",  "sign", "min",  "max",  "pow",  "if",
                                 "mod", "floor", "atan2", "pi",   "and",  "or",   "not",  "true", "false"}) {
    EXPECT_TRUE(is_reserved_name(name)) << name;
  }
  for (const char* const name : {"x", "Sin", "sin1", "e", "", "AND"})
    EXPECT_FALSE(is_reserved_name(name)) << name;
}

TEST(Operators, AreSpelledAsInASpec) {
  EXPECT_EQ(spelling(Operator::constant), "number");
  EXPECT_EQ(spelling(Operator::maximum), "max");
  EXPECT_EQ(spelling(Operator::arctangent), "atan");
  EXPECT_EQ(spelling(Operator::sign), "sign");
  EXPECT_EQ(spelling(Operator::modulo), "mod");
  EXPECT_EQ(spelling(Operator::less_equal), "<=");
  EXPECT_EQ(spelling(Operator::logical_and), "and");
  EXPECT_EQ(spelling(Operator::literal_false), "false");
}

TEST(Operators, EveryFunctionParsesUnderItsSpelling) {
  for (auto op = Operator::sine; op <= Operator::floor; op = Operator(int(op) + 1)) {
    const std::string text = std::string(spelling(op)) + "(x)";
    EXPECT_EQ(link_xyz(text).nodes.back().op, op) << text;
  }
}

}  // namespace
}  // namespace coordreq

#include <gtest/gtest.h>

#include <string>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

std::string nested(const std::string& open, const std::string& inner, const std::string& close, int levels) {
  return repeated(open, levels) + inner + repeated(close, levels);
}

TEST(Nesting, AThousandLevelsAreFine) {
  EXPECT_EQ(value_at(nested("(", "x", ")", 1000), 7), 7);
  EXPECT_EQ(value_at(nested("abs(", "x", ")", 1000), -7), 7);
  EXPECT_EQ(value_at(nested("1 + (", "x", ")", 1000), 7), 1007);
  EXPECT_EQ(value_at(repeated("-", 1000) + "x", 7), 7);
  EXPECT_EQ(value_at(repeated("1^", 1000) + "x", 7), 1);
  EXPECT_EQ(truth_at(repeated("not ", 1000) + "x < 1", 0), Truth::yes);
}

TEST(Nesting, DeeperIsAnErrorWithAPlace) {
  const std::string line = "the expression is nested deeper than 1000 levels (/safe, column 1001)";
  EXPECT_EQ(error_of([] { (void)link_xyz(nested("(", "x", ")", 1001)); }), line);
  EXPECT_EQ(error_of([] { (void)link_xyz(nested("(", "x", ")", 10'000)); }), line);
  EXPECT_EQ(error_of([] { (void)link_xyz(repeated("-", 1'000'000) + "x"); }), line);
  for (const char* const open : {"abs(", "1^", "1 + (", "not ", "if(true, 1, "}) {
    const std::string text = repeated(open, 10'000);
    EXPECT_NE(error_of([&] { (void)link_xyz(text); }).find("nested deeper than 1000 levels (/safe, column "),
              std::string::npos)
        << open;
  }
}

TEST(Nesting, FlatExpressionsMayBeLong) {
  EXPECT_EQ(value_at("0" + repeated(" + x", 100'000), Rational(1, 2)), 50'000);
  EXPECT_EQ(value_at("x" + repeated(" - 1", 100'000), 0), -100'000);
  EXPECT_EQ(truth_at("true" + repeated(" and x < 1", 100'000), 0), Truth::yes);
  EXPECT_EQ(truth_at("x" + repeated(" <= x", 100'000), 0), Truth::yes);
  EXPECT_EQ(value_at("max(x" + repeated(", x + 1", 100'000) + ")", 0), 1);
}

TEST(Nesting, ChainsOfDefinitionsMayBeLong) {
  auto last = std::make_shared<const Program>(link_xyz("x"));
  const Lookup lookup = [&](std::string_view) -> Binding { return last; };
  for (int i = 0; i < 1'000; ++i) {
    last = std::make_shared<const Program>(link("last + sin(last)", lookup, ExpectedType::number, ""));
  }
  // Copied out instead of shared this would be 2^1000 nodes.
  EXPECT_EQ(last->nodes.size(), 2'001U);
}

TEST(Size, ConstantsStayBounded) {
  const Program program = link_xyz("((((7^4000)^4000)^4000)^4000)^4000 + x");
  const std::array slots{exactly(1)};
  EXPECT_FALSE(Evaluator<RationalInterval>(program).number(slots).is_point());
  std::string harmonic = "0";
  for (int i = 1; i < 20'000; ++i) harmonic += " + 1/" + std::to_string(i);
  EXPECT_FALSE(link_xyz(harmonic).nodes.empty());
}

}  // namespace
}  // namespace coordreq

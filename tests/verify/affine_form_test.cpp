#include "verify/affine_form.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

/// In x and y; z is 3.
std::optional<ExactForm> multiplied_out(std::string_view text) {
  const auto look_up = [](std::string_view name) -> Binding {
    return std::uint32_t(name == "x" ? 0 : name == "y" ? 1 : 2);
  };
  const Program program = link(text, look_up, ExpectedType::number, "/test");
  return affine_form(program, {0, 1}, {0, 0, 3});
}

TEST(ExactForm, SquaresThatCancelLeaveIt) {
  const std::optional<ExactForm> form = multiplied_out("(x + 1)^2 - x*x + z*y/4");
  ASSERT_TRUE(form);
  EXPECT_EQ(form->slope, (std::vector<Rational>{2, Rational(3) / 4}));
  EXPECT_EQ(form->constant, 1);
}

TEST(ExactForm, ProductsOfVariablesAreNone) {
  EXPECT_FALSE(multiplied_out("x*y"));
  EXPECT_FALSE(multiplied_out("x^2 + y"));
  EXPECT_FALSE(multiplied_out("1/x"));
  EXPECT_TRUE(multiplied_out("x*y - y*x"));
}

TEST(ExactForm, FunctionsOfConstantsThatAreRationalCount) {
  EXPECT_FALSE(multiplied_out("sin(x)"));
  EXPECT_FALSE(multiplied_out("x + sin(1)"));
  EXPECT_FALSE(multiplied_out("if(x > 0, x, y)"));
  EXPECT_TRUE(multiplied_out("if(x > 0, -10, -10)"));  // a branch that is both: the expression knows
  const std::optional<ExactForm> form = multiplied_out("x*abs(-z) + max(z, 5) + if(z == 3, y, x^2)");
  ASSERT_TRUE(form);
  EXPECT_EQ(form->slope, (std::vector<Rational>{3, 1}));
  EXPECT_EQ(form->constant, 5);
}

TEST(ExactForm, AConditionOnADifferenceThatIsConstantIsDecided) {
  const std::optional<ExactForm> form = multiplied_out("if(x + 1 > x, 2*x, y)");
  ASSERT_TRUE(form);
  EXPECT_EQ(form->slope.front(), 2);
}

}  // namespace
}  // namespace coordreq

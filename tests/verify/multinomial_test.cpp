#include "verify/multinomial.hpp"

#include <gtest/gtest.h>

#include "expression/evaluate.hpp"

namespace coordreq {
namespace {

Multinomial multiplied_out(std::string_view text) {
  const auto look_up = [](std::string_view name) -> Binding {
    return name == "x" ? std::uint32_t{0} : std::uint32_t{1};
  };
  const Program program = link(text, look_up, ExpectedType::number, "/test");
  Evaluator<Multinomial> evaluator(program);
  return evaluator.number(std::vector{Multinomial::variable(0), Multinomial::variable(1)});
}

TEST(Multinomial, SquaresThatCancelLeaveAnAffineForm) {
  const Multinomial form = multiplied_out("(x + 1)^2 - x*x + 3*y/4");
  EXPECT_TRUE(form.is_affine());
  EXPECT_EQ(form.slope(0), 2);
  EXPECT_EQ(form.slope(1), Rational(3) / 4);
  EXPECT_EQ(form.constant.lower, 1);
}

TEST(Multinomial, ProductsOfVariablesAreNotAffine) {
  EXPECT_TRUE(multiplied_out("x*y").known);
  EXPECT_FALSE(multiplied_out("x*y").is_affine());
  EXPECT_FALSE(multiplied_out("x^2 + y").is_affine());
}

TEST(Multinomial, FunctionsOfVariablesAreUnknownThoseOfConstantsAreEnclosed) {
  EXPECT_FALSE(multiplied_out("sin(x)").known);
  EXPECT_FALSE(multiplied_out("if(x > 0, x, y)").known);
  const Multinomial form = multiplied_out("x + sin(1)");
  EXPECT_TRUE(form.is_affine());
  EXPECT_LT(form.constant.lower, form.constant.upper);
}

TEST(Multinomial, AConditionOnADifferenceThatIsConstantIsDecided) {
  EXPECT_EQ(multiplied_out("if(x + 1 > x, 2*x, y)").slope(0), 2);
}

}  // namespace
}  // namespace coordreq

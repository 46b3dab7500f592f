#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

Rational constant(std::string_view text) {
  return constant_value(link_xyz(text), "/states/0/upper");
}

TEST(ConstantValue, RationalOperationsAreExact) {
  EXPECT_EQ(constant("0.1 + 0.2"), Rational(3, 10));
  EXPECT_EQ(constant("1/3"), Rational(1, 3));
  EXPECT_EQ(constant("2*pi"), 2 * exact(3.141592653589793));
  EXPECT_EQ(constant("-pi/7"), exact(3.141592653589793) / -7);
  EXPECT_EQ(constant("1e400 / 1e399"), 10);
  EXPECT_EQ(constant("1.5^20"), Rational(3486784401, 1048576));
}

TEST(ConstantValue, RationalValuesOfFunctionsAreExact) {
  EXPECT_EQ(constant("sqrt(4)"), 2);
  EXPECT_EQ(constant("sqrt(1/9)"), Rational(1, 3));
  EXPECT_EQ(constant("cos(0)"), 1);
  EXPECT_EQ(constant("8^(1/3)"), 2);
  EXPECT_EQ(constant("0^0"), 1);
  EXPECT_EQ(constant("0^0.3"), 0);
}

TEST(ConstantValue, IrrationalValuesAreNearestDoublesAndExactFromThenOn) {
  EXPECT_EQ(constant("sqrt(2)"), exact(std::sqrt(2.0)));
  EXPECT_EQ(constant("2*sqrt(2) + 1/3"), 2 * exact(std::sqrt(2.0)) + Rational(1, 3));
  EXPECT_EQ(constant("exp(1)"), exact(2.71828182845904523536));
  EXPECT_EQ(constant("sin(1/3)"), exact(0.32719469679615224418));
  EXPECT_EQ(constant("2^0.5"), exact(std::sqrt(2.0)));
  EXPECT_EQ(constant("2^(1/3)"), exact(1.25992104989487316477));
  EXPECT_EQ(constant("sin(pi)"), exact(1.22464679914735317720e-16));
  EXPECT_EQ(constant("cos(pi)"), -1);
  EXPECT_EQ(constant("exp(-1e10)"), 0);
}

TEST(ConstantValue, ConditionsChooseBranches) {
  EXPECT_EQ(constant("if(sqrt(2) < 1.5, 3, 1/0)"), 3);
  EXPECT_EQ(constant("if(exp(1) > 3 or not (log(2) < 1), 1/0, min(exp(0), 2))"), 1);
  EXPECT_EQ(constant("if(1/0 < 1 or exp(1) < 3, 5, 6)"), 5);
}

struct ConstantError {
  std::string text;
  std::string line;
};
class ConstantErrors : public testing::TestWithParam<ConstantError> {};

TEST_P(ConstantErrors, SayWhatIsWrong) {
  EXPECT_EQ(error_of([&] { (void)constant(GetParam().text); }), GetParam().line + " (/states/0/upper)");
}

INSTANTIATE_TEST_SUITE_P(
    All, ConstantErrors,
    testing::Values(ConstantError{"1/0", "'1/0' divides by zero"},
                    ConstantError{"1/(2 - 2)", "'1/(2 - 2)' divides by zero"},
                    ConstantError{"sqrt(-1)", "'sqrt(-1)' has no real value"},
                    ConstantError{"log(0) * 0", "'log(0) * 0' has no real value"},
                    ConstantError{"acos(2)", "'acos(2)' has no real value"},
                    ConstantError{"(-8)^(1/3)", "'(-8)^(1/3)' has no real value"},
                    ConstantError{"0^-1", "'0^-1' divides by zero"},
                    ConstantError{"if(1/0 > 1, 1, 2)", "'if(1/0 > 1, 1, 2)' has no real value"},
                    ConstantError{"exp(1000)", "'exp(1000)' is not finite"},
                    ConstantError{"1e400", "'1e400' is too large for a double"},
                    ConstantError{"2^100000", "'2^100000' is too large to be computed exactly"},
                    ConstantError{"1 +\n1/0", "'1 + 1/0' divides by zero"},
                    ConstantError{"x + 1", "'x + 1' is not a constant"},
                    ConstantError{"1 < 2", "expected a number, found a condition"}));

}  // namespace
}  // namespace coordreq

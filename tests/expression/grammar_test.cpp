#include <gtest/gtest.h>

#include <string>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

struct NumberCase {
  std::string text;
  Rational expected;
};
struct ConditionCase {
  std::string text;
  bool expected;
};

class Numbers : public testing::TestWithParam<NumberCase> {};
class Conditions : public testing::TestWithParam<ConditionCase> {};

TEST_P(Numbers, HaveTheirValue) {
  EXPECT_EQ(value_at(GetParam().text, 2, 3, 5), GetParam().expected) << GetParam().text;
}

// x = 2, y = 3, z = 5
INSTANTIATE_TEST_SUITE_P(
    Precedence, Numbers,
    testing::Values(NumberCase{"1 + 2 * 3", 7}, NumberCase{"(1 + 2) * 3", 9}, NumberCase{"x - y - z", -6},
                    NumberCase{"x - (y - z)", 4}, NumberCase{"x / y / z", Rational(2, 15)},
                    NumberCase{"x / y * z", Rational(10, 3)}, NumberCase{"-x^2", -4}, NumberCase{"(-x)^2", 4},
                    NumberCase{"2^3^2", 512}, NumberCase{"2^2*3", 12}, NumberCase{"(2^3)^2", 64},
                    NumberCase{"2^-1", Rational(1, 2)}, NumberCase{"2^+1", 2},
                    NumberCase{"2^-x^2", Rational(1, 16)}, NumberCase{"2 * -x", -4}, NumberCase{"-x * y", -6},
                    NumberCase{"- - x", 2}, NumberCase{"+x", 2}, NumberCase{"x - -y", 5},
                    NumberCase{"x*y^2", 18}, NumberCase{"-x + y", 1}));

INSTANTIATE_TEST_SUITE_P(Literals, Numbers,
                         testing::Values(NumberCase{"0.1", Rational(1, 10)}, NumberCase{".5", Rational(1, 2)},
                                         NumberCase{"5.", 5}, NumberCase{"1e3", 1000},
                                         NumberCase{"1.5E-1", Rational(3, 20)}, NumberCase{"2e+2", 200},
                                         NumberCase{" \t\r\n7 ", 7}, NumberCase{"1e2-1", 99},
                                         NumberCase{"pi", exact(3.141592653589793)}));

INSTANTIATE_TEST_SUITE_P(
    Functions, Numbers,
    testing::Values(NumberCase{"min(x, y)", 2}, NumberCase{"max(x, y, z)", 5},
                    NumberCase{"min(z, y, x, 1)", 1}, NumberCase{"pow(x, y)", 8}, NumberCase{"abs(x - y)", 1},
                    NumberCase{"sign(x - y)", -1}, NumberCase{"sign(0)", 0}, NumberCase{"floor(z/x)", 2},
                    NumberCase{"floor(-z/x)", -3}, NumberCase{"floor(y)", 3}, NumberCase{"mod(z, x)", 1},
                    NumberCase{"mod(-z, x)", 1}, NumberCase{"mod(z, -x)", -1},
                    NumberCase{"mod(y/x, 1/3)", Rational(1, 6)}, NumberCase{"mod(2*y, y)", 0},
                    NumberCase{"atan2(x - 2, y)", 0}, NumberCase{"sqrt(x + x)", 2},
                    NumberCase{"exp(x - 2)", 1}, NumberCase{"if(x < y, x, z)", 2},
                    NumberCase{"if(x > y, x, z)", 5}, NumberCase{"if(x < y and y < z, 1, 0)", 1},
                    NumberCase{"0^0", 1},
                    NumberCase{"sin(0) + cos(0) + tan(0) + asin(0) + acos(1) + atan(0)", 1},
                    NumberCase{"sinh(0) + cosh(0) + tanh(0) + log(1)", 1}));

TEST_P(Conditions, HaveTheirTruth) {
  EXPECT_EQ(truth_at(GetParam().text, 2, 3, 5), to_truth(GetParam().expected)) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(Comparisons, Conditions,
                         testing::Values(ConditionCase{"x < y", true}, ConditionCase{"y < x", false},
                                         ConditionCase{"x <= 2", true}, ConditionCase{"x >= 2", true},
                                         ConditionCase{"x > 2", false}, ConditionCase{"x == 2", true},
                                         ConditionCase{"x != 2", false}, ConditionCase{"x + 1 == y", true},
                                         ConditionCase{"0.1 + 0.2 == 0.3", true},
                                         ConditionCase{"x < y < z", true}, ConditionCase{"x < z < y", false},
                                         ConditionCase{"x < y <= 3 != z", true},
                                         ConditionCase{"z > y > x >= 2", true},
                                         ConditionCase{"1 < x > 1", true}));

INSTANTIATE_TEST_SUITE_P(Logic, Conditions,
                         testing::Values(ConditionCase{"true", true}, ConditionCase{"false", false},
                                         ConditionCase{"not false", true}, ConditionCase{"!false", true},
                                         ConditionCase{"not not true", true}, ConditionCase{"!!true", true},
                                         ConditionCase{"true or false and false", true},
                                         ConditionCase{"(true or false) and false", false},
                                         ConditionCase{"true || false && false", true},
                                         ConditionCase{"not x > y", true}, ConditionCase{"! x > y", true},
                                         ConditionCase{"not false and false", false},
                                         ConditionCase{"not (false and false)", true},
                                         ConditionCase{"(x < y) and not (z < y)", true},
                                         ConditionCase{"x<y&&y<z", true}, ConditionCase{"x>y||y>z", false},
                                         ConditionCase{"true and not false", true},
                                         ConditionCase{"((x)) < (y)", true}));

}  // namespace
}  // namespace coordreq

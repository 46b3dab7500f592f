#include <gtest/gtest.h>

#include <string>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

struct ErrorCase {
  std::string text;
  std::string line;
  ExpectedType expected = ExpectedType::any;
};

class ErrorLine : public testing::TestWithParam<ErrorCase> {};

TEST_P(ErrorLine, NamesThePlaceWhatWasFoundAndWhatWasExpected) {
  EXPECT_EQ(error_of([&] { (void)link_xyz(GetParam().text, GetParam().expected); }), GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, ErrorLine,
    testing::Values(
        ErrorCase{"x + * 2", "expected a number, a name or '(', found '*' (/safe, column 5)"},
        ErrorCase{"", "expected a number, a name or '(', found the end (/safe, column 1)"},
        ErrorCase{"x +", "expected a number, a name or '(', found the end (/safe, column 4)"},
        ErrorCase{"x y", "expected an operator or the end, found 'y' (/safe, column 3)"},
        ErrorCase{"2x", "expected an operator or the end, found 'x' (/safe, column 2)"},
        ErrorCase{"1.2.3", "expected an operator or the end, found '.3' (/safe, column 4)"},
        ErrorCase{"(x", "expected an operator or ')', found the end (/safe, column 3)"},
        ErrorCase{"x)", "expected an operator or the end, found ')' (/safe, column 2)"},
        ErrorCase{"()", "expected a number, a name or '(', found ')' (/safe, column 2)"},
        ErrorCase{"sin x", "expected '(', found 'x' (/safe, column 5)"},
        ErrorCase{"max(x; y)", "expected an operator, ',' or ')', found ';' (/safe, column 6)"},
        ErrorCase{"max(x, )", "expected a number, a name or '(', found ')' (/safe, column 8)"},
        ErrorCase{"x = 2",
                  "expected an operator or the end, found '=', did you mean '=='? (/safe, column 3)"},
        ErrorCase{"x => y",
                  "expected an operator or the end, found '=', did you mean '>='? (/safe, column 3)"},
        ErrorCase{"x =< y",
                  "expected an operator or the end, found '=', did you mean '<='? (/safe, column 3)"},
        ErrorCase{"x & y",
                  "expected an operator or the end, found '&', did you mean '&&'? (/safe, column 3)"},
        ErrorCase{"x % 2",
                  "expected an operator or the end, found '%', did you mean 'mod(a, b)'? (/safe, column 3)"},
        ErrorCase{"x | y",
                  "expected an operator or the end, found '|', did you mean '||'? (/safe, column 3)"},
        ErrorCase{
            "|x - y| + 1",
            "expected a number, a name or '(', found '|', did you mean 'abs(x - y)'? (/safe, column 1)"},
        ErrorCase{"1 + |x",
                  "expected a number, a name or '(', found '|', did you mean 'abs(...)'? (/safe, column 5)"},
        ErrorCase{"x ** 2",
                  "expected a number, a name or '(', found '*', did you mean '^'? (/safe, column 4)"},
        ErrorCase{"*x", "expected a number, a name or '(', found '*' (/safe, column 1)"},
        ErrorCase{"x + not y", "expected a number, a name or '(', found 'not' (/safe, column 5)"},
        ErrorCase{"x < !y", "expected a number, a name or '(', found '!' (/safe, column 5)"},
        ErrorCase{"1 + ln(x)", "'ln' is not a function, did you mean 'log'? (/safe, column 5)"},
        ErrorCase{"fabs(x)", "'fabs' is not a function, did you mean 'abs'? (/safe, column 1)"},
        ErrorCase{"arctan(x)", "'arctan' is not a function, did you mean 'atan'? (/safe, column 1)"},
        ErrorCase{"sgn(x)", "'sgn' is not a function, did you mean 'sign'? (/safe, column 1)"},
        ErrorCase{"power(x, 2)", "'power' is not a function, did you mean 'pow'? (/safe, column 1)"},
        ErrorCase{"Sin(x)", "'Sin' is not a function, did you mean 'sin'? (/safe, column 1)"},
        ErrorCase{"log10(x)", "'log10' is not a function, did you mean 'log(x)/log(10)'? (/safe, column 1)"},
        ErrorCase{"2*Pi", "'Pi' is not defined, did you mean 'pi'? (/safe, column 3)"},
        ErrorCase{"e^x", "'e' is not defined, did you mean 'exp(1)'? (/safe, column 1)"},
        ErrorCase{
            "foo(2)",
            "'foo' is not a function, expected one of if, mod, pow, atan2, min, max, sin, cos, tan, asin, "
            "acos, atan, sinh, cosh, tanh, exp, log, sqrt, abs, sign, floor (/safe, column 1)"},
        ErrorCase{
            "x(2)",
            "'x' is not a function, expected one of if, mod, pow, atan2, min, max, sin, cos, tan, asin, "
            "acos, atan, sinh, cosh, tanh, exp, log, sqrt, abs, sign, floor (/safe, column 1)"},
        ErrorCase{"1e6000", "the number '1e6000' is out of range (/safe, column 1)"}));

INSTANTIATE_TEST_SUITE_P(
    Characters, ErrorLine,
    testing::Values(
        ErrorCase{"x + \xC3\xA9", "expected a number, a name or '(', found U+00E9 (/safe, column 5)"},
        ErrorCase{"x \x1B[31m", "expected an operator or the end, found U+001B (/safe, column 3)"},
        ErrorCase{std::string("x\0y", 3), "expected an operator or the end, found U+0000 (/safe, column 2)"},
        ErrorCase{"x \xFFy", "expected an operator or the end, found byte 0xFF (/safe, column 3)"},
        ErrorCase{"x \xE2\x82", "expected an operator or the end, found byte 0xE2 (/safe, column 3)"},
        ErrorCase{"x \xF0\x9F\x98\x80", "expected an operator or the end, found U+1F600 (/safe, column 3)"},
        ErrorCase{"'\xC3\xA9", "expected a number, a name or '(', found ''' (/safe, column 1)"}));

INSTANTIATE_TEST_SUITE_P(
    Lines, ErrorLine,
    testing::Values(
        ErrorCase{"x +\n  * y", "expected a number, a name or '(', found '*' (/safe, line 2, column 3)"},
        ErrorCase{"x *\r\n\r\n", "expected a number, a name or '(', found the end (/safe, line 3, column 1)"},
        ErrorCase{"x x\n", "expected an operator or the end, found 'x' (/safe, line 1, column 3)"}));

INSTANTIATE_TEST_SUITE_P(Names, ErrorLine,
                         testing::Values(ErrorCase{"x + x3", "'x3' is not defined (/safe, column 5)"},
                                         ErrorCase{"X", "'X' is not defined (/safe, column 1)"},
                                         ErrorCase{std::string(60, 'a'),
                                                   "'" + std::string(40, 'a') +
                                                       "...' is not defined (/safe, column 1)"}));

INSTANTIATE_TEST_SUITE_P(
    Arguments, ErrorLine,
    testing::Values(ErrorCase{"1 + sin(x, y)", "sin takes 1 argument, found 2 (/safe, column 5)"},
                    ErrorCase{"sin()", "sin takes 1 argument, found 0 (/safe, column 1)"},
                    ErrorCase{"pow(x)", "pow takes 2 arguments, found 1 (/safe, column 1)"},
                    ErrorCase{"min(x)", "min takes 2 or more arguments, found 1 (/safe, column 1)"},
                    ErrorCase{"if(x < y, x)", "if takes 3 arguments, found 2 (/safe, column 1)"}));

INSTANTIATE_TEST_SUITE_P(
    Types, ErrorLine,
    testing::Values(
        ErrorCase{"1 + (x < y)", "expected a number, found a condition (/safe, column 5)"},
        ErrorCase{"x and y", "expected a condition, found a number (/safe, column 1)"},
        ErrorCase{"x < y and y", "expected a condition, found a number (/safe, column 11)"},
        ErrorCase{"not x", "expected a condition, found a number (/safe, column 5)"},
        ErrorCase{"-(x < y)", "expected a number, found a condition (/safe, column 2)"},
        ErrorCase{"+true", "expected a number, found a condition (/safe, column 2)"},
        ErrorCase{"sin(true)", "expected a number, found a condition (/safe, column 5)"},
        ErrorCase{"if(x, y, z)", "expected a condition, found a number (/safe, column 4)"},
        ErrorCase{"if(x < y, x < y, z)", "expected a number, found a condition (/safe, column 11)"},
        ErrorCase{"(x < y) == (y < z)", "expected a number, found a condition (/safe, column 1)"},
        ErrorCase{"true != false", "expected a number, found a condition (/safe, column 1)"},
        ErrorCase{" x + y", "expected a condition, found a number (/safe, column 2)",
                  ExpectedType::condition},
        ErrorCase{"x < y", "expected a number, found a condition (/safe, column 1)", ExpectedType::number}));

TEST(ErrorLine, WithoutAPlaceHasTheColumnOnly) {
  EXPECT_EQ(error_of([] { (void)link("x", look_up_xyz, ExpectedType::condition, ""); }),
            "expected a condition, found a number (column 1)");
}

TEST(ErrorLine, ExitCodeIsInvalidInput) {
  try {
    (void)link_xyz("x +");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::invalid_input);
  }
}

TEST(ErrorLine, MentionedNamesReportsSyntaxErrorsToo) {
  EXPECT_EQ(error_of([] { (void)mentioned_names("x + ", "/definitions/r"); }),
            "expected a number, a name or '(', found the end (/definitions/r, column 5)");
}

}  // namespace
}  // namespace coordreq

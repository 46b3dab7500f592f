#include "cell/state_text.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace coordreq {
namespace {

const std::vector<std::string> kNames = {"x1", "x2"};

std::string defect_of_state(const std::string& text) {
  try {
    static_cast<void>(parse_state(text, kNames, "--at"));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(StateText, ValuesAreExact) {
  EXPECT_EQ(parse_value("0.1", ""), Rational(1) / 10);
  EXPECT_EQ(parse_value(" 1/3 ", ""), Rational(1) / 3);
  EXPECT_EQ(parse_value("-(2 + 0.5)^2", ""), Rational(-25) / 4);
  EXPECT_EQ(parse_value("pi", ""), exact(3.141592653589793));
}

TEST(StateText, NamesInAnyOrder) {
  EXPECT_EQ(parse_state("x2=1, x1 = -0.5", kNames, ""), (std::vector<Rational>{Rational(-1) / 2, 1}));
}

TEST(StateText, CommasInParenthesesBelongToAValue) {
  EXPECT_EQ(parse_state("x1=max(1,2),x2=min(3,if(1 < 2, 4, 5))", kNames, ""), (std::vector<Rational>{2, 3}));
  EXPECT_EQ(parse_state("x1=if(1 <= 2, 4, 5),x2=if(1 == 2, 4, 5)", kNames, ""),
            (std::vector<Rational>{4, 5}));
}

TEST(StateText, ErrorsNameWhatIsWrong) {
  EXPECT_EQ(defect_of_state("x1=1"), "no value for the state 'x2' (--at)");
  EXPECT_EQ(defect_of_state(""), "expected NAME=VALUE, found '' (--at)");
  EXPECT_EQ(defect_of_state("x1=1,x2"), "expected NAME=VALUE, found 'x2' (--at)");
  EXPECT_EQ(defect_of_state("x1=1 x2=2"), "expected a comma between states, found 'x1=1 x2=2' (--at)");
  EXPECT_EQ(defect_of_state("x1=1,y=2"), "'y' is no state, expected 'x1' or 'x2' (--at)");
  EXPECT_EQ(defect_of_state("x1=1,x2=2,x1=3"), "'x1' is given twice (--at)");
  EXPECT_EQ(defect_of_state("x1=,x2=2"), "expected a number, found nothing (--at, x1)");
  EXPECT_EQ(defect_of_state("x1=1/0,x2=2"), "'1/0' divides by zero (--at, x1)");
  EXPECT_EQ(defect_of_state("x1=1 < 2,x2=2"), "expected a number, found a condition (--at, x1, column 1)");
  EXPECT_EQ(defect_of_state("x1=R,x2=2"), "'R' is not defined (--at, x1, column 1)");
}

}  // namespace
}  // namespace coordreq

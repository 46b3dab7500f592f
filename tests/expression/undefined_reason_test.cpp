#include "expression/undefined_reason.hpp"

#include <gtest/gtest.h>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

/// For x in [-1, 1] and y in [2, 3].
std::string reason_of(const std::string& text) {
  const auto look_up = [](std::string_view name) -> Binding {
    if (name == "x") return std::uint32_t{0};
    if (name == "y") return std::uint32_t{1};
    return NotDefined{};
  };
  const Program program = link(text, look_up, ExpectedType::number, "/test");
  const std::vector<Interval> slots{{-1.0, 1.0}, {2.0, 3.0}};
  return undefined_reason(program, slots);
}

TEST(UndefinedReason, NamesTheOperationAndItsOperand) {
  EXPECT_EQ(reason_of("y + 1/x"), "division by a number in [-1, 1]");
  EXPECT_EQ(reason_of("1/(y - y)"), "division by a number in [-1, 1]");
  EXPECT_EQ(reason_of("y/0"), "division by 0");
  EXPECT_EQ(reason_of("x/y + sqrt(x - 2)"), "square root of a number in [-3, -1]");
  EXPECT_EQ(reason_of("log(x + 1)"), "logarithm of a number in [0, 2]");
  EXPECT_EQ(reason_of("sin(x^0.5)"), "a number in [-1, 1] to the power of 0.5");
  EXPECT_EQ(reason_of("asin(y)"), "asin of a number in [2, 3]");
  EXPECT_EQ(reason_of("tan(y + x)"), "tan of a number in [1, 4]");
}

TEST(UndefinedReason, IsTheInnermostOne) {
  EXPECT_EQ(reason_of("sqrt(1/x)"), "division by a number in [-1, 1]");
  EXPECT_EQ(reason_of("max(log(x), 1/(y - 1))"), "logarithm of a number in [-1, 1]");
}

TEST(UndefinedReason, PassesByBranchesThatAreNotTaken) {
  EXPECT_EQ(reason_of("if(y > 1, log(x), 1/x)"), "logarithm of a number in [-1, 1]");
  EXPECT_EQ(reason_of("if(y < 1, log(x), 1/x)"), "division by a number in [-1, 1]");
  EXPECT_EQ(reason_of("if(1/x > 0, 1, y)"), "division by a number in [-1, 1]");
  EXPECT_EQ(reason_of("if(y > 2.5 and not sqrt(x) > 0, 1, 2)"), "square root of a number in [-1, 1]");
}

TEST(UndefinedReason, IsEmptyWhereAllIsDefined) {
  EXPECT_EQ(reason_of("1/y"), "");
  EXPECT_EQ(reason_of("if(y > 1, x, 1/x)"), "");
}

}  // namespace
}  // namespace coordreq

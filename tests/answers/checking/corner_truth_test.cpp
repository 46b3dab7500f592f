#include "answers/checking/corner_truth.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

Truth everywhere(std::string_view text, const RationalInterval& x, const RationalInterval& y) {
  const auto look_up = [](std::string_view name) -> Binding {
    return name == "x" ? std::uint32_t{0} : std::uint32_t{1};
  };
  const Program condition = link(text, look_up, ExpectedType::condition, "/test");
  return CornerTruth(condition, {0, 1}).everywhere({x, y});
}

const RationalInterval kUnit{.lower = 0, .upper = 1};
const RationalInterval kSecond{.lower = 1, .upper = 2};

TEST(CornerTruth, ARepeatedVariableThatTouchesTheBorderIsProven) {
  // (x - y)^2 multiplied out, at most 4 where x = 0 and y = 2
  EXPECT_EQ(everywhere("x^2 - 2*x*y + y^2 <= 4", kUnit, kSecond), Truth::yes);
  EXPECT_EQ(everywhere("x^2 - 2*x*y + y^2 < 4", kUnit, kSecond), Truth::no);
}

TEST(CornerTruth, ABumpInsideTheBoxIsHalvedUntilItIsMonotone) {
  EXPECT_EQ(everywhere("x*(1 - x) + 0*y <= 0.26", kUnit, kUnit), Truth::yes);
  EXPECT_EQ(everywhere("x*(1 - x) + 0*y <= 0.24", kUnit, kUnit), Truth::no);
}

TEST(CornerTruth, AJumpIsNotTakenForMonotone) {
  EXPECT_EQ(everywhere("if(x < 0.3, 0, 1) * y <= 0.5 or y > 0.4", kUnit, kUnit), Truth::yes);
  EXPECT_EQ(everywhere("if(x < 0.3, 0, 1) * y <= 0.5", kUnit, kUnit), Truth::no);
}

TEST(CornerTruth, WhatIsUndefinedIsNotProven) {
  EXPECT_NE(everywhere("sqrt(x - 0.5) >= 0 and y >= 0", kUnit, kUnit), Truth::yes);
  EXPECT_NE(everywhere("if(sqrt(x - 0.5) > 2, 1, 2) >= 1 and y >= 0", kUnit, kUnit), Truth::yes);
}

}  // namespace
}  // namespace coordreq

#include "verify/piece_choices.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

bool jumps(std::string_view text, const Rational& period) {
  const auto look_up = [](std::string_view name) -> Binding {
    return name == "y" ? std::uint32_t{0} : std::uint32_t{1};
  };
  return jumps_at_seam(link(text, look_up, ExpectedType::number, "/test"), 0, period);
}

const Rational kTurn = Rational(6283185307) / 1000000000;

TEST(SeamUse, WholeTurnsOfSineAndItsKinGoOn) {
  EXPECT_FALSE(jumps("2 + sin(y) + x*cos(3*y - x)", kTurn));
  EXPECT_FALSE(jumps("tan(y/2)^2", kTurn));
  EXPECT_FALSE(jumps("x^2", kTurn));
}

TEST(SeamUse, PartsOfATurnJump) {
  EXPECT_TRUE(jumps("sin(y)", 2));
  EXPECT_TRUE(jumps("sin(y/2)", kTurn));
  EXPECT_TRUE(jumps("tan(y/4)", kTurn));
  EXPECT_TRUE(jumps("cos(1.5*y)", kTurn));
}

TEST(SeamUse, NumbersJump) {
  EXPECT_TRUE(jumps("y", kTurn));
  EXPECT_TRUE(jumps("sin(y^2)", kTurn));
  EXPECT_TRUE(jumps("sin(x*y)", kTurn));
  EXPECT_TRUE(jumps("sin(y) + 0.1*y", kTurn));
}

}  // namespace
}  // namespace coordreq

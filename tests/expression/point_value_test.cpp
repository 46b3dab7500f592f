#include "expression/point_value.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression_helpers.hpp"

namespace coordreq {
namespace {

double value(std::string_view text, const Rational& x, const Rational& y = 0) {
  const Program program = link_xyz(text, ExpectedType::number);
  const std::array<Rational, 3> slots{x, y, Rational(0)};
  return PointValue(program).value(slots);
}

TEST(PointValue, RationalOperationsRoundOnlyOnce) {
  const Rational tenth = Rational(1) / 10;
  EXPECT_EQ(value("x + y - 0.3", tenth, Rational(1) / 5), 0.0);
  EXPECT_NE(0.1 + 0.2 - 0.3, 0.0);  // what double arithmetic makes of it
  EXPECT_EQ(value("max(abs(x - y), 0.05) - 0.1", tenth, Rational(1) / 5), 0.0);
}

TEST(PointValue, IrrationalOnesAreThoseOfDoubleArithmetic) {
  EXPECT_EQ(value("sin(x) + 1", 2), std::sin(2.0) + 1);
}

TEST(PointValue, UndefinedOnesAreNotANumber) {
  EXPECT_TRUE(std::isnan(value("1 / x", 0)));
  EXPECT_TRUE(std::isnan(value("sqrt(x)", -1)));
}

}  // namespace
}  // namespace coordreq

#include "cell/margin.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace coordreq {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Program condition(std::string_view text) {
  const auto lookup = [](std::string_view name) -> Binding {
    return name == "x" ? Binding(0U) : name == "y" ? Binding(1U) : Binding(NotDefined{});
  };
  return link(text, lookup, ExpectedType::condition, "test");
}

/// The margin at x = 2, y = 5, which both ways of computing it have to give.
double margin(std::string_view text) {
  const Program program = condition(text);
  const std::array<Rational, 2> exact{Rational(2), Rational(5)};
  const std::array<double, 2> doubles{2, 5};
  Margin margin(program);
  const double value = margin.value(exact);
  EXPECT_EQ(margin.approximate(doubles), value) << text;
  return value;
}

TEST(Margin, OfAComparisonIsTheSignedDifference) {
  EXPECT_EQ(margin("x <= 6"), 4);
  EXPECT_EQ(margin("x < 1"), -1);
  EXPECT_EQ(margin("y >= x"), 3);
  EXPECT_EQ(margin("y > 7"), -2);
}

TEST(Margin, OfEqualitiesIsTheDistance) {
  EXPECT_EQ(margin("x == 6"), -4);
  EXPECT_EQ(margin("x == 2"), 0);
  EXPECT_FALSE(std::signbit(margin("x == 2")));
  EXPECT_EQ(margin("x != y"), 3);
  EXPECT_EQ(margin("x != 2"), 0);
}

TEST(Margin, AndIsTheSmallerOrTheLarger) {
  EXPECT_EQ(margin("x <= 6 and y <= 6"), 1);
  EXPECT_EQ(margin("x <= 6 or y <= 6"), 4);
  EXPECT_EQ(margin("x <= 1 or y >= 9 or x == y"), -1);
  EXPECT_EQ(margin("1 <= x <= 6"), 1);
}

TEST(Margin, NotTurnsItRound) {
  EXPECT_EQ(margin("not (x <= 6 and y <= 6)"), -1);
  EXPECT_EQ(margin("not (x == 6)"), 4);
}

TEST(Margin, ConstantsAreInfinite) {
  EXPECT_EQ(margin("true"), kInfinity);
  EXPECT_EQ(margin("false"), -kInfinity);
  EXPECT_EQ(margin("x <= 6 and true"), 4);
  EXPECT_EQ(margin("x <= 6 or false"), 4);
}

TEST(Margin, ConditionsInsideNumbersOnlyChoose) {
  EXPECT_EQ(margin("if(x > 1, y, 100) <= 6"), 1);
  EXPECT_EQ(margin("if(x > 3, y, 100) <= 6"), -94);
}

TEST(Margin, WhereNothingIsKnownItIsMinusInfinity) {
  EXPECT_EQ(margin("sqrt(x - y) >= 0"), -kInfinity);
  EXPECT_EQ(margin("not (sqrt(x - y) >= 0)"), -kInfinity);
  EXPECT_EQ(margin("sqrt(x - y) >= 0 and x <= 6"), -kInfinity);
}

TEST(Margin, UndefinedPartsDoNotMatterWhereKleenesLogicDecides) {
  EXPECT_EQ(margin("sqrt(x - y) >= 0 or x <= 6"), 4);
  EXPECT_EQ(margin("sqrt(x - y) >= 0 or x >= 6"), -kInfinity);
  EXPECT_EQ(margin("sqrt(x - y) >= 0 and x >= 6"), -4);
}

TEST(Margin, IsExactBeforeItsLastRounding) {
  const Program program = condition("max(abs(x - y), 0) >= 0.1");
  const std::array<Rational, 2> slots{Rational(3) / 10, Rational(1) / 5};
  EXPECT_EQ(Margin(program).value(slots), 0.0);
}

}  // namespace
}  // namespace coordreq

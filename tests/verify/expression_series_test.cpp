// Every function of the language, in the verifier's own arithmetic.

#include "verify/expression_series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "answers/checking/sloped.hpp"
#include "expression/domains.hpp"
#include "expression/functions.hpp"

namespace coordreq {
namespace {

/// f(x, y).
Program program_of(Operator op) {
  Program program;
  program.nodes = {{Operator::variable, 0, 0, 0}, {Operator::variable, 1, 0, 0}, {op, 0, 1, 0}};
  return program;
}

constexpr double kPoints[][2] = {{0.375, 0.625}, {0.75, -0.5}, {0.25, 2.0}};
constexpr double kStep = 1e-6;

double slope_at(const NumberFunction& f, double a, double b) {
  return (f.at_point(a + kStep, b) - f.at_point(a - kStep, b)) / (2 * kStep);
}

TEST(ExpressionSeries, EveryFunctionHasItsValueAndItsSlope) {
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(f.spelling);
    const Program program = program_of(f.op);
    ExpressionSeries series(program);
    for (const auto& [a, b] : kPoints) {
      std::vector<ArbSeries> slots(2);
      slots[0].assign(Arb(a));
      slots[0].set(1, Arb(1.0));
      slots[1].assign(Arb(b));
      const ArbSeries& found = series(slots, 2);
      EXPECT_NEAR(found[0].approximately(), f.at_point(a, b), 1e-12);
      EXPECT_NEAR(found[1].approximately(), slope_at(f, a, b), 1e-6);
      EXPECT_EQ(series.smoothness(), Smoothness::analytic);
    }
  }
}

/// -(f(x, y) x / y - f(x, y))^2 of series, term by term and all at once.
TEST(ExpressionSeries, EveryFunctionIsExtendedToWhatItIs) {
  constexpr slong kLength = 6;
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(f.spelling);
    Program program = program_of(f.op);
    program.constants = {Rational(2)};
    for (const Program::Node& node : {Program::Node{Operator::multiply, 2, 0, 0},
                                      {Operator::divide, 3, 1, 0},
                                      {Operator::subtract, 4, 2, 0},
                                      {Operator::constant, 0, 0, 0},
                                      {Operator::power, 5, 6, 0},
                                      {Operator::negate, 7, 0, 0}})
      program.nodes.push_back(node);
    for (const auto& [a, b] : kPoints) {
      ExpressionSeries at_once(program), extended(program);
      std::vector<ArbSeries> slots(2);
      for (slong k = 0; k < kLength; ++k) {
        slots[0].set(k, Arb(k == 0 ? a : 0.5 / static_cast<double>(k)));
        slots[1].set(k, k == 0 ? Arb(b) : hull(Arb(-0.25), Arb(-0.125)));
      }
      const ArbSeries all = at_once(slots, kLength);
      for (slong k = 0; k < kLength; ++k) {
        const ArbSeries& found = k == 0 ? extended(slots, 1) : extended.extend(slots, k + 1);
        const double tolerance = 1e-7 * (1 + std::abs(all[k].approximately()) + all[k].width());
        EXPECT_NEAR(found[k].lower().approximately(), all[k].lower().approximately(), tolerance);
        EXPECT_NEAR(found[k].upper().approximately(), all[k].upper().approximately(), tolerance);
      }
    }
  }
}

TEST(ExpressionSeries, AChoiceCountsAsMoreThanASumAndAFunctionAsMoreThanAChoice) {
  const auto operations = [](Operator op) { return ExpressionSeries(program_of(op)).operations(); };
  EXPECT_EQ(operations(Operator::add), 3U);
  EXPECT_EQ(operations(Operator::negate), 3U);
  for (const Operator op : {Operator::minimum, Operator::maximum, Operator::absolute, Operator::floor})
    EXPECT_EQ(operations(op), 10U) << spelling(op);
  for (const Operator op : {Operator::sine, Operator::hyperbolic_tangent, Operator::square_root})
    EXPECT_EQ(operations(op), 14U) << spelling(op);
}

TEST(ExpressionSeries, OfARangeEveryFunctionHoldsTheValuesInIt) {
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(f.spelling);
    const Program program = program_of(f.op);
    ExpressionSeries series(program);
    for (const auto& [a, b] : kPoints) {
      std::vector<ArbSeries> slots(2);
      slots[0].assign(hull(Arb(a), Arb(a + 0.125)));
      slots[1].assign(Arb(b));
      const Arb range = series(slots, 1)[0];
      for (const double fraction : {0.0, 0.5, 1.0}) {
        const double value = f.at_point(a + 0.125 * fraction, b);
        EXPECT_LE(range.lower().approximately(), value + 1e-12);
        EXPECT_GE(range.upper().approximately(), value - 1e-12);
      }
    }
  }
}

TEST(ExpressionSeries, ASquareEndsAtTheSquaresOfTheEnds) {
  const std::pair<double, double> ranges[] = {{-1, 2}, {1, 2},  {-2, -1}, {0, 3},
                                              {-3, 0}, {-2, 2}, {5, 5},   {0, 0}};
  for (const auto& [from, to] : ranges) {
    const Arb square = squared(hull(Arb(from), Arb(to)));
    const double least = from <= 0 && to >= 0 ? 0.0 : std::min(from * from, to * to);
    const double most = std::max(from * from, to * to);
    EXPECT_TRUE(square.holds(hull(Arb(least), Arb(most)))) << from << ' ' << to;
    EXPECT_TRUE(square.is_nonnegative()) << from << ' ' << to;
    EXPECT_NEAR(square.lower().approximately(), least, 1e-8 * most);
    EXPECT_NEAR(square.upper().approximately(), most, 1e-8 * most);
  }
}

TEST(ExpressionSeries, WhatIsNotDefinedHasNoSizeEither) {
  const Arb undefined = Arb(1.0) / hull(Arb(-1.0), Arb(1.0));
  ASSERT_FALSE(undefined.is_finite());
  EXPECT_FALSE(absolute(undefined).is_finite());
  EXPECT_FALSE(squared(undefined).is_finite());
}

TEST(ExpressionSeries, AnAngleJumpsAcrossItsCutOnly) {
  const Program program = program_of(Operator::angle);
  ExpressionSeries series(program);
  const auto range = [&](double y, double to, double x) {
    std::vector<ArbSeries> slots(2);
    slots[0].assign(hull(Arb(y), Arb(to)));
    slots[1].assign(Arb(x));
    return series(slots, 2)[0];
  };
  EXPECT_NEAR(range(-1, 1, 1).width(), std::acos(0.0), 1e-6);
  EXPECT_EQ(series.smoothness(), Smoothness::analytic);
  EXPECT_GE(range(-1, 1, -1).width(), 2 * std::acos(-1.0));
  EXPECT_EQ(series.smoothness(), Smoothness::jumps);
  EXPECT_FALSE(range(-1, 1, 0).is_finite());
}

TEST(ExpressionSeries, FloorJumpsWhereItsArgumentIsWhole) {
  const Program program = program_of(Operator::floor);
  ExpressionSeries series(program);
  const auto range = [&](double from, double to) {
    std::vector<ArbSeries> slots(2);
    slots[0].assign(hull(Arb(from), Arb(to)));
    return series(slots, 2)[0];
  };
  EXPECT_TRUE(range(1.25, 1.75).is_point());
  EXPECT_EQ(series.smoothness(), Smoothness::analytic);
  const Arb across = range(-1.5, 0.5);
  EXPECT_TRUE(across.holds(Arb(-2.0)) && across.holds(Arb(0.0)));
  EXPECT_EQ(series.smoothness(), Smoothness::jumps);
}

TEST(Sloped, EveryFunctionHasItsSlope) {
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(f.spelling);
    for (const auto& [a, b] : kPoints) {
      const Sloped<Interval> x{.value = Interval(a), .gradient = {Interval(1.0)}};
      const Sloped<Interval> y{.value = Interval(b)};
      const Sloped<Interval> found = is_unary_function(f.op) ? apply(f.op, x) : apply(f.op, x, y);
      const double slope = slope_at(f, a, b);
      ASSERT_EQ(found.gradient.size(), 1U);
      EXPECT_LE(found.gradient[0].lower, slope + 1e-6);
      EXPECT_GE(found.gradient[0].upper, slope - 1e-6);
      EXPECT_LE(found.gradient[0].upper - found.gradient[0].lower, 1e-6);
    }
  }
}

}  // namespace
}  // namespace coordreq

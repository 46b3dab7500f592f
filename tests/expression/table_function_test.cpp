#include "expression/table_function.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "expression/dual.hpp"
#include "expression/expression_helpers.hpp"
#include "expression/undefined_reason.hpp"

namespace coordreq {
namespace {

using Rationals = std::vector<Rational>;

Program link_table(std::string_view text, const TableFunction& table,
                   ExpectedType expected = ExpectedType::number) {
  const TableLookup tables{[&](std::string_view name) { return name == "t" ? &table : nullptr; }};
  return link(text, look_up_xyz, tables, expected, "/test");
}

int pick(int least, int most) {
  return *rc::gen::inRange(least, most + 1);
}
Rational random_number(int least, int most) {
  return Rational(pick(least * 16, most * 16)) / pick(3, 16);
}
Rationals random_axis(int most) {
  Rationals axis{random_number(-4, 4)};
  const int count = pick(2, most);
  while (static_cast<int>(axis.size()) < count)
    axis.push_back(axis.back() + random_number(0, 2) + Rational(1, 7));
  return axis;
}
Rationals random_values(std::size_t count) {
  Rationals values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(random_number(-5, 5));
  return values;
}

/// Of the definition: between the neighbouring points, by the nearest end outside.
Rational interpolated(const Rationals& x, const Rationals& value, const Rational& at) {
  if (at <= x.front()) return value.front();
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (at <= x[i]) return value[i - 1] + (value[i] - value[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
  }
  return value.back();
}

Rational value_of(const Program& program, const Rational& x, const Rational& y = 0) {
  const std::vector<RationalInterval> slots{exactly(x), exactly(y), exactly(0)};
  const RationalInterval value = Evaluator<RationalInterval>(program).number(slots);
  EXPECT_TRUE(value.is_point() && value.total);
  return value.lower;
}

RationalInterval range_of(const Program& program, const Rational& from, const Rational& to) {
  const std::vector<RationalInterval> slots{{from, to, true, true}, exactly(0), exactly(0)};
  return Evaluator<RationalInterval>(program).number(slots);
}

/// The least and the greatest value, which are at ends or points.
RationalInterval true_range(const Rationals& x, const Rationals& value, const Rational& from,
                            const Rational& to) {
  RationalInterval range = exactly(interpolated(x, value, from));
  const auto add = [&](const Rational& number) {
    range.lower = std::min(range.lower, number);
    range.upper = std::max(range.upper, number);
  };
  add(interpolated(x, value, to));
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (from <= x[i] && x[i] <= to) add(value[i]);
  }
  return range;
}

/// The expression, whatever the order in which its nodes stand.
std::string tree_of(const Program& program) {
  std::vector<std::string> texts;
  for (const Program::Node& node : program.nodes) {
    std::string text(spelling(node.op));
    if (node.op == Operator::constant) text = to_text(program.constants[node.a]);
    if (node.op == Operator::variable) text = std::string(kVariables[node.a]);
    const std::array operands{node.a, node.b, node.c};
    for (std::size_t i = 0; i < operand_count(node.op); ++i)
      text += (i == 0 ? "(" : ", ") + texts[operands[i]] + (i + 1 == operand_count(node.op) ? ")" : "");
    texts.push_back(text);
  }
  return texts.back();
}

void expect_same(const Rationals& x, const Rationals& value, const std::string& text) {
  const std::string first = to_text(x.front()), last = to_text(x.back());
  const TableFunction table = linear_table(x, value, BeyondAxis::clamp);
  const Program made = link_table("t(x)", table);
  const std::string inside = "max(min(x, " + last + "), " + first + ")";
  std::string written = text;
  for (std::size_t at = 0; (at = written.find('v', at)) != std::string::npos; at += inside.size())
    written.replace(at, 1, inside);
  const Program expected = link_xyz(written, ExpectedType::number);
  EXPECT_EQ(tree_of(made), tree_of(expected));
}

TEST(TableFunction, IsExactAtRationalPoints) {
  EXPECT_TRUE(rc::check([] {
    const Rationals x = random_axis(12);
    const Rationals value = random_values(x.size());
    const TableFunction table = linear_table(x, value, BeyondAxis::clamp);
    const Program program = link_table("t(x)", table);
    for (const Rational& at : x) RC_ASSERT(value_of(program, at) == interpolated(x, value, at));
    for (int n = 0; n < 10; ++n) {
      const Rational at = random_number(-8, 20);
      RC_ASSERT(value_of(program, at) == interpolated(x, value, at));
    }
  }));
}

TEST(TableFunction, IntervalsEncloseItsRange) {
  EXPECT_TRUE(rc::check([] {
    const Rationals x = random_axis(12);
    const Rationals value = random_values(x.size());
    const TableFunction table = linear_table(x, value, BeyondAxis::clamp);
    const Program program = link_table("t(x)", table);
    const Rational from = random_number(-6, 12);
    const Rational to = from + random_number(0, 6);
    const RationalInterval all = true_range(x, value, from, to);
    const RationalInterval range = range_of(program, from, to);
    RC_ASSERT(range.total);
    RC_ASSERT(range.lower <= all.lower);
    RC_ASSERT(range.upper == all.upper);
  }));
}

TEST(TableFunction, IntervalsGiveTheExactRangeWhereItTurnsAtMostOnce) {
  EXPECT_TRUE(rc::check([] {
    const Rationals x = random_axis(12);
    Rationals value = random_values(x.size());
    const auto turn = value.begin() + pick(0, static_cast<int>(x.size()));
    std::sort(value.begin(), turn);
    std::sort(turn, value.end(), std::greater<>());
    if (turn != value.begin() && turn != value.end() && pick(0, 1) == 0) std::iter_swap(turn - 1, turn);
    std::sort(value.begin(), turn);
    std::sort(turn, value.end(), std::greater<>());
    const int sign = pick(0, 1) == 0 ? 1 : -1;
    for (Rational& number : value) number *= sign;
    const TableFunction table = linear_table(x, value, BeyondAxis::clamp);
    const Program program = link_table("t(x)", table);
    const Rational from = random_number(-6, 12);
    const Rational to = from + random_number(0, 6);
    const RationalInterval all = true_range(x, value, from, to);
    const RationalInterval range = range_of(program, from, to);
    RC_ASSERT(range.lower == all.lower);
    RC_ASSERT(range.upper == all.upper);
  }));
}

TEST(TableFunction, AtAKinkItsDerivativesAreTheHullOfTwoSlopes) {
  EXPECT_TRUE(rc::check([] {
    const Rationals x = random_axis(12);
    const Rationals value = random_values(x.size());
    RC_PRE(x.size() > 2);
    const TableFunction table = linear_table(x, value, BeyondAxis::clamp);
    const Program program = link_table("t(x)", table);
    const auto i = static_cast<std::size_t>(pick(1, static_cast<int>(x.size()) - 2));
    const double at = nearest_double(x[i]);
    const std::vector<Dual> slots{Dual::variable({at - 1e-9, at + 1e-9}, 0), Dual::constant({0, 0}),
                                  Dual::constant({0, 0})};
    const Dual result = Evaluator<Dual>(program).number(slots);
    const auto slope = [&](std::size_t k) {
      return nearest_double((value[k] - value[k - 1]) / (x[k] - x[k - 1]));
    };
    const auto [low, high] = std::minmax({slope(i), slope(i + 1)});
    RC_ASSERT(result.gradient[0].lower <= low);
    RC_ASSERT(result.gradient[0].upper >= high);
    RC_ASSERT(result.jump.lower == 0.0);
    // Lines that happen to meet at the kink belong to the hull, too.
    const auto meets = [&](std::size_t k) {
      const Rational line = value[k] + (value[k] - value[k - 1]) / (x[k] - x[k - 1]) * (x[i] - x[k]);
      return k != i && k != i + 1 && abs(Rational(line - value[i])) < Rational(1, 1000);
    };
    for (std::size_t k = 1; k < x.size(); ++k) RC_PRE(!meets(k));
    for (std::size_t k = 0; k < x.size(); ++k) RC_PRE(k == i || value[k] != value[i]);
    RC_ASSERT(result.gradient[0].lower >= std::min(low, 0.0) - 1e-9);
    RC_ASSERT(result.gradient[0].upper <= std::max(high, 0.0) + 1e-9);
    if (low * high > 0) {
      RC_ASSERT(result.gradient[0].lower >= low - 1e-9);
      RC_ASSERT(result.gradient[0].upper <= high + 1e-9);
    }
  }));
}

TEST(TableFunction, OfTwoVariablesIsExactAtRationalPoints) {
  EXPECT_TRUE(rc::check([] {
    const Rationals x = random_axis(5);
    const Rationals y = random_axis(5);
    std::vector<Rationals> rows;
    for (std::size_t j = 0; j < y.size(); ++j) rows.push_back(random_values(x.size()));
    const TableFunction table = bilinear_table(x, y, rows, BeyondAxis::clamp);
    const Program program = link_table("t(x, y)", table);
    for (int n = 0; n < 10; ++n) {
      const Rational at_x = n == 0 ? x.back() : random_number(-8, 12);
      const Rational at_y = n == 0 ? y.front() : random_number(-8, 12);
      Rationals column;
      for (const Rationals& row : rows) column.push_back(interpolated(x, row, at_x));
      RC_ASSERT(value_of(program, at_x, at_y) == interpolated(y, column, at_y));
    }
  }));
}

TEST(TableFunction, ThatSaysTheSameAsAFunctionIsThatFunction) {
  expect_same({-5, 0, 5}, {5, 0, 5}, "abs(v)");
  expect_same({-5, -2, 0, 1, 5}, {5, 2, 0, 1, 5}, "abs(v)");
  expect_same({-5, 1, 7}, {-12, 0, -12}, "-2*abs(v + -1)");
  expect_same({-5, 2, 5}, {-5, 2, 2}, "min(v, 2)");
  expect_same({-5, 2, 5}, {2, 2, 5}, "max(2, v)");
  expect_same({-5, 5}, {-5, 5}, "v");
}

TEST(TableFunction, MayRefuseArgumentsOutside) {
  const TableFunction table = linear_table(Rationals{0, 10}, Rationals{1, 2}, BeyondAxis::refuse);
  const Program program = link_table("t(x)", table);
  EXPECT_EQ(value_of(program, 10), 2);
  EXPECT_TRUE(range_of(program, 0, 10).total);
  EXPECT_FALSE(range_of(program, 0, 11).total);
  EXPECT_FALSE(range_of(program, -1, 5).total);
  EXPECT_FALSE(range_of(program, 11, 12).total);
  EXPECT_EQ(constant_value(link_table("t(4)", table), "/test"), Rational(7, 5));
  EXPECT_EQ(error_of([&] { (void)constant_value(link_table("t(11)", table), "/test"); }),
            "'t(11)' has no real value (/test)");
  const std::vector<Interval> slots{{4.0, 12.0}, {0.0, 0.0}, {0.0, 0.0}};
  EXPECT_EQ(undefined_reason(program, slots), "a table from 0 to 10 at a number in [4, 12]");
}

TEST(TableFunction, IsCalledWithAsManyNumbersAsItHasAxes) {
  const TableFunction one = linear_table(Rationals{0, 1}, Rationals{1, 2}, BeyondAxis::clamp);
  const TableFunction two =
      bilinear_table(Rationals{0, 1}, Rationals{0, 1}, {{0, 1}, {2, 3}}, BeyondAxis::clamp);
  const auto error = [](std::string_view text, const TableFunction& table) {
    return error_of([&] { (void)link_table(text, table); });
  };
  EXPECT_EQ(error("1 + t(x, y)", one), "t takes 1 argument, found 2 (/test, column 5)");
  EXPECT_EQ(error("t(x)", two), "t takes 2 arguments, found 1 (/test, column 1)");
  EXPECT_EQ(error("t + 1", one), "expected '(', found '+' (/test, column 3)");
  EXPECT_EQ(error("t(x < 1)", one), "expected a number, found a condition (/test, column 3)");
  EXPECT_EQ(error("s(x)", one).substr(0, 21), "'s' is not a function");
  EXPECT_EQ(value_of(link_table("t(t(x)) + t(0)", one), 0), 3);
}

}  // namespace
}  // namespace coordreq

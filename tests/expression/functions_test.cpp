#include "expression/functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "expression/domains.hpp"
#include "expression/dual.hpp"

namespace coordreq {
namespace {

constexpr double kPi = 3.14159265358979323846;
const std::vector<double> kPoints{-2.25, -1.0, -0.75, -0.375, 0.0, 0.25, 0.5, 1.0, 1.75, 3.0};

std::string name_of(const NumberFunction& f) {
  return "'" + std::string(f.spelling) + "' of " + std::to_string(is_unary_function(f.op) ? 1 : 2);
}

/// Calls `check(function, a, b)` for every function at points; `b` is `a` for functions of one number.
template <class Check>
void at_all_points(const Check& check) {
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(name_of(f));
    for (const double a : kPoints) {
      if (is_unary_function(f.op)) {
        check(f, a, a);
        continue;
      }
      for (const double b : kPoints) check(f, a, b);
    }
  }
}

/// Nodes that are evaluated as they are put.
class Values final : public NodeWriter {
 public:
  explicit Values(std::vector<Interval> values) : values_(std::move(values)) {}
  Index put_operation(Operator op, Index a, Index b) override {
    const Interval value = is_unary_function(op) ? apply(op, values_[a]) : apply(op, values_[a], values_[b]);
    return add(value);
  }
  Index put_number(int value) override { return add({double(value), double(value)}); }
  [[nodiscard]] const Interval& operator[](Index i) const { return values_[i]; }

 private:
  Index add(const Interval& value) {
    values_.push_back(value);
    return static_cast<Index>(values_.size() - 1);
  }
  std::vector<Interval> values_;
};

TEST(NumberFunctions, EveryColumnIsFilled) {
  EXPECT_EQ(number_functions().size(), std::size_t(Operator::floor) - std::size_t(Operator::add) + 1);
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(name_of(f));
    EXPECT_EQ(&number_function(f.op), &f);
    EXPECT_FALSE(f.spelling.empty());
    EXPECT_GE(f.fewest, is_unary_function(f.op) ? 1U : 2U);
    EXPECT_GE(f.most, f.fewest);
    EXPECT_TRUE(f.at_point != nullptr && f.on_interval != nullptr && f.on_rationals != nullptr);
    EXPECT_TRUE(f.on_dual != nullptr && f.exactly != nullptr && f.rounded != nullptr);
    EXPECT_TRUE(f.undefined != nullptr);
    EXPECT_NE(f.half_turns, 0);
    EXPECT_GE(f.series.rule, SeriesRule::sum);
    const bool needs_factor =
        f.series.rule == SeriesRule::chain || f.series.rule == SeriesRule::inverse_chain;
    EXPECT_EQ(f.series.factor != nullptr, needs_factor);
  }
}

TEST(NumberFunctions, EveryEvaluationGivesTheSameValue) {
  at_all_points([](const NumberFunction& f, double a, double b) {
    SCOPED_TRACE(testing::Message() << a << ", " << b);
    const double value = f.at_point(a, b);
    const Interval range = f.on_interval({a, a}, {b, b});
    const RationalInterval exact_range = f.on_rationals({exact(a), exact(a)}, {exact(b), exact(b)});
    EXPECT_EQ(range.total, !std::isnan(value));
    EXPECT_EQ(exact_range.total, range.total);
    const std::optional<Rational> rational = f.exactly(exact(a), exact(b));
    const Constant constant = rational ? Constant{} : f.rounded(exact(a), exact(b));
    if (std::isnan(value)) {
      EXPECT_FALSE(f.is_defined_everywhere());
      EXPECT_FALSE(rational.has_value());
      EXPECT_NE(constant.outcome, Constant::Outcome::value);
      return;
    }
    EXPECT_TRUE(range.contains(value));
    EXPECT_LE(range.upper - range.lower, 1e-13 * (1.0 + std::fabs(value)));
    const Rational best = rational ? *rational : constant.value;
    EXPECT_TRUE(rational || constant.outcome == Constant::Outcome::value);
    EXPECT_LE(exact_range.lower, best);
    EXPECT_GE(exact_range.upper, best);
    EXPECT_NEAR(nearest_double(best), value, 1e-13 * (1.0 + std::fabs(value)));
  });
}

TEST(NumberFunctions, DerivativesEncloseDifferences) {
  constexpr double kStep = 1e-3;
  at_all_points([](const NumberFunction& f, double a, double b) {
    const bool of_one = is_unary_function(f.op);
    const Dual x = Dual::variable({a, a + kStep}, 0);
    const Dual y = of_one ? x : Dual::variable({b, b + kStep}, 1);
    const Dual range = f.on_dual(x, y);
    if (!range.total) return;
    const double change = f.at_point(a + kStep, of_one ? a : b + kStep) - f.at_point(a, b);
    Interval bound = (range.jump + range.jump);
    for (std::size_t j = 0; j < range.directions; ++j)
      bound = bound + range.gradient[j] * Interval{kStep, kStep};
    EXPECT_LE(bound.lower - 1e-12, change) << a << ", " << b;
    EXPECT_GE(bound.upper + 1e-12, change) << a << ", " << b;
  });
}

TEST(NumberFunctions, FactorsOfSeriesAreDerivatives) {
  at_all_points([](const NumberFunction& f, double a, double /*b*/) {
    if (f.series.factor == nullptr) return;
    const Dual value = f.on_dual(Dual::variable({a, a}, 0), Dual::variable({a, a}, 0));
    Values nodes({{a, a}, value.value});
    const Interval factor = nodes[f.series.factor(nodes, 0, 1)];
    // At its ends asin has no finite derivative.
    if (!value.total || factor.contains(0.0)) return;
    const double slope = value.gradient[0].lower;
    const double expected = f.series.rule == SeriesRule::chain ? slope : 1.0 / slope;
    EXPECT_NEAR(factor.lower, expected, 1e-12 * (1.0 + std::fabs(expected))) << a;
  });
}

TEST(NumberFunctions, RepeatThemselvesAfterTheirPeriodAndNoSooner) {
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(name_of(f));
    const auto differs = [&f](double period) {
      return std::fabs(f.at_point(0.375 + period, 0.375) - f.at_point(0.375, 0.375)) > 1e-9;
    };
    if (f.half_turns == NumberFunction::kNever) continue;
    EXPECT_FALSE(differs(f.half_turns * kPi));
    EXPECT_FALSE(differs(-f.half_turns * kPi));
    EXPECT_TRUE(differs(0.5 * f.half_turns * kPi));
  }
}

TEST(NumberFunctions, AreDefinedEverywhereIfTheySaySo) {
  const Interval wide{-1e3, 1e3};
  for (const NumberFunction& f : number_functions()) {
    SCOPED_TRACE(name_of(f));
    EXPECT_EQ(f.on_interval(wide, wide).total, f.is_defined_everywhere());
  }
}

}  // namespace
}  // namespace coordreq

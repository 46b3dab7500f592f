// The verifier's own integrator against closed solutions.

#include <gtest/gtest.h>

#include <cmath>

#include "spec/read_spec.hpp"
#include "verify/flow_bounds.hpp"
#include "verify/map_bounds.hpp"

namespace coordreq {
namespace {

ProblemSpec flow(const std::string& x, const std::string& y, const std::string& disturbances = "") {
  return read_spec(
      R"json({"coordreq": 1, "name": "flow",
"states": [{"name": "x", "lower": -4, "upper": 4, "step": 1}, {"name": "y", "lower": -4, "upper": 4, "step": 1}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "one", "inputs": ["u"]}],
"disturbances": [)json" +
          disturbances +
          R"json(], "dynamics": {"time": "continuous", "period": 0.5, "equations": {"x": ")json" + x +
          R"json(", "y": ")json" + y + R"json("}}, "safe": "true"})json",
      "flow");
}

std::optional<Interval> end_of(const ProblemSpec& spec, const Interval& x, const Interval& y,
                               const Interval& w = {0.0, 0.0}) {
  std::vector<Interval> slots(spec.slot_count());
  slots[0] = x;
  slots[1] = y;
  if (!spec.disturbances.empty()) slots[spec.disturbance_slot(0)] = w;
  return FlowBounds(spec, influences_on(spec, 0), 0).after_period(slots, 3);
}

void expect_tight(const std::optional<Interval>& found, double lower, double upper, double slack = 1e-10) {
  ASSERT_TRUE(found);
  EXPECT_LE(found->lower, lower + 1e-15);
  EXPECT_GE(found->upper, upper - 1e-15);
  EXPECT_NEAR(found->lower, lower, slack);
  EXPECT_NEAR(found->upper, upper, slack);
}

TEST(FlowBounds, DecayIsTheHull) {
  expect_tight(end_of(flow("-x", "0"), {1, 2}, {0, 0}), std::exp(-0.5), 2 * std::exp(-0.5));
}

TEST(FlowBounds, ARotatedBoxHasItsExtremesAtCorners) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  expect_tight(end_of(flow("-y", "x"), {1, 2}, {-1, 1}), c - s, 2 * c + s);
}

TEST(FlowBounds, LogisticGrowthIsTheHull) {
  const auto exact = [](double x) { return x * std::exp(0.5) / (1 + x * (std::exp(0.5) - 1)); };
  expect_tight(end_of(flow("x*(1 - x)", "0"), {0.25, 0.75}, {0, 0}), exact(0.25), exact(0.75));
}

TEST(FlowBounds, EveryFunctionOfTheLanguageIsExpanded) {
  // x = t for each of them: f(x) over f(x), or an identity
  for (const std::string one :
       {"exp(x)/exp(x)", "cos(x)^2 + sin(x)^2", "cosh(x)^2 - sinh(x)^2", "sqrt(x + 1)/sqrt(1 + x)",
        "log(exp(x + 1)) - x", "tan(atan(x)) - x + 1", "tanh(x)*cosh(x)/sinh(x)", "sin(asin(x/4))*4 - x + 1",
        "cos(acos(x/4))*4 - x + 1", "abs(-x)/x", "sign(x)", "min(1, 2 + x)", "max(1, x - 9)",
        "if(x > 0, 1, 7)", "(x + 1)^3/(1 + x)^3", "(x + 1)^0.5/sqrt(x + 1)", "pow(x + 2, -1)*(x + 2)"}) {
    SCOPED_TRACE(one);
    expect_tight(end_of(flow(one, "0"), {0.25, 0.25}, {0, 0}), 0.75, 0.75, 1e-8);
  }
}

TEST(FlowBounds, ADisturbanceThatSwitchesIsCovered) {
  const ProblemSpec spec = flow("y + w", "-x", R"({"name": "w", "lower": -1, "upper": 1})");
  // The kernel cos(t) keeps its sign for half a second: the extreme is a constant disturbance.
  expect_tight(end_of(spec, {0, 0}, {0, 0}, {-1, 1}), -std::sin(0.5), std::sin(0.5), 1e-9);
}

TEST(FlowBounds, ASolutionThatEscapesHasNoBound) {
  EXPECT_FALSE(end_of(flow("x^2", "0"), {2, 3}, {0, 0}));
}

TEST(MapBounds, MonotonePartsGiveTheHullOthersAreHalved) {
  const auto look_up = [](std::string_view name) -> Binding {
    return name == "x" ? std::uint32_t{0} : std::uint32_t{1};
  };
  const Program cubic = link("x^3 - x + y - y", look_up, ExpectedType::number, "/test");
  MapBounds bounds(cubic, {0, 1});
  expect_tight(bounds.over({{1, 2}, {0, 5}}, 3), 0, 6, 1e-12);
  const double least = -2 / (3 * std::sqrt(3.0));
  expect_tight(bounds.over({{0, 1}, {0, 5}}, 12), least, 0, 0.02);
}

TEST(MapBounds, AnUndefinedMapHasNoBounds) {
  const Program root = link(
      "sqrt(x)", [](std::string_view) -> Binding { return std::uint32_t{0}; }, ExpectedType::number, "/test");
  EXPECT_FALSE(MapBounds(root, {0}).over({{-1, 1}}, 3));
  EXPECT_TRUE(MapBounds(root, {0}).over({{0, 1}}, 3));
}

}  // namespace
}  // namespace coordreq

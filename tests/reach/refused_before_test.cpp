// Systems that have an answer although parts of them leave the domain, stop, decay fast or go round far.

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "reach/attack.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

SystemSpec refused_flow(const std::string& states, const std::string& equations) {
  return read_system(test::spec_text(states, "continuous", equations), "test");
}

std::int64_t cell_of(const Abstraction& a, const std::vector<std::int64_t>& index) {
  std::int64_t cell = 0;
  for (std::size_t i = 0; i < index.size(); ++i) cell += index[i] * a.grid.stride(i);
  return cell;
}

const std::string kPosition = R"({"name": "p", "lower": -2, "upper": 2, "step": 0.5}, )";
const std::string kSpeed = R"({"name": "v", "lower": -1, "upper": 1, "step": 0.25)";

TEST(OffLimits, ChainsOfIntegratorsAreExactWhereNothingIsStopped) {
  const std::string equations = R"("p": "v", "v": "u")";
  const Abstraction stopped =
      test::build(refused_flow(kPosition + kSpeed + R"(, "outside": "stop"})", equations));
  const Abstraction free = test::build(refused_flow(kPosition + kSpeed + "}", equations));
  int same = 0;
  for (std::int64_t k = 0; k < 9; ++k) {
    const double speed = -1.0 + 0.25 * static_cast<double>(k);
    const double inputs[] = {-1.0, 0.0, 0.5};
    for (std::int64_t u = 0; u < 3; ++u) {
      const double moved = 0.5 * inputs[u];
      const bool off =
          speed - 0.125 + std::min(moved, 0.0) > -1.0 && speed + 0.125 + std::max(moved, 0.0) < 1.0;
      if (!off) continue;
      const std::int64_t cell = cell_of(stopped, {4, k});
      EXPECT_EQ(stopped.raw(0, cell, u), free.raw(0, cell, u)) << speed << " " << inputs[u];
      EXPECT_EQ(stopped.raw(1, cell, u), free.raw(1, cell, u)) << speed << " " << inputs[u];
      ++same;
    }
  }
  EXPECT_EQ(same, 18);
  EXPECT_TRUE(stopped.exact);
}

/// Where v' = u, stopped at -1 and 1, and p' = v lead from (0, v) within half a second: how far p goes, and
/// v.
std::pair<double, double> stopped_chain(double v, double u) {
  constexpr double kPeriod = 0.5;
  const double limit = u < 0.0 ? -1.0 : 1.0;
  const double moving = u == 0.0 ? kPeriod : std::min(kPeriod, (limit - v) / u);
  const double end = v + u * moving;
  return {v * moving + u * moving * moving / 2.0 + end * (kPeriod - moving), end};
}

TEST(OffLimits, SolutionsStayInPostsNearLimitsToo) {
  const Abstraction a =
      test::build(refused_flow(kPosition + kSpeed + R"(, "outside": "stop"})", R"("p": "v", "v": "u")"));
  const double inputs[] = {-1.0, 0.0, 0.5};
  for (std::int64_t k = 0; k < 9; ++k) {
    const std::int64_t cell = cell_of(a, {4, k});
    for (std::int64_t u = 0; u < 3; ++u) {
      for (int index = 0; index <= 20; ++index) {
        const double v = std::clamp(-1.0 + 0.25 * (static_cast<double>(k) - 0.5 + index / 20.0), -1.0, 1.0);
        const auto [moved, end] = stopped_chain(v, inputs[u]);
        const auto position = [&](std::size_t i, double value) {
          return (value - a.grid[i].first.get_d()) / a.grid[i].step.get_d();
        };
        for (const double p : {-0.25, 0.25}) {
          EXPECT_GE(position(0, p + moved), a.raw(0, cell, u).first - 0.5 - 1e-9) << v;
          EXPECT_LE(position(0, p + moved), a.raw(0, cell, u).last + 0.5 + 1e-9) << v;
        }
        EXPECT_GE(position(1, end), a.raw(1, cell, u).first - 0.5 - 1e-9) << v;
        EXPECT_LE(position(1, end), a.raw(1, cell, u).last + 0.5 + 1e-9) << v;
      }
    }
  }
}

TEST(LeftBefore, StateThatDependsOnOneThatEscapesIsBlocked) {
  const std::string states = R"({"name": "x", "lower": -1, "upper": 1, "step": 0.5}, )"
                             R"({"name": "y", "lower": -1, "upper": 1, "step": 0.5})";
  const Abstraction a = test::build(refused_flow(states, R"json("x": "0.1*y", "y": "-5*y^2 - 2 + 0*u")json"));
  for (std::int64_t k = 0; k < 5; ++k) {
    const std::int64_t cell = cell_of(a, {2, k});
    // From y in [0.75, 1.25] it is between -0.6 and -0.3 after a period.
    EXPECT_EQ(a.resolved(0, cell, 0).blocked || a.resolved(1, cell, 0).blocked, k < 4) << k;
  }
}

TEST(LeftBefore, EscapeIsAnErrorWhereTheStateItselfCannotBlock) {
  const std::string states = R"({"name": "x", "lower": -1, "upper": 1, "step": 0.5, "outside": "safe"}, )"
                             R"({"name": "y", "lower": -1, "upper": 1, "step": 0.5})";
  EXPECT_THROW((void)test::build(refused_flow(states, R"json("x": "0.1*y", "y": "-5*y^2 - 2 + 0*u")json")),
               SpecError);
}

TEST(LeftBefore, PoleBeyondAnUnsafeSideIsNoError) {
  const std::string states = R"({"name": "x", "lower": -1.6, "upper": 1.6, "step": 0.4}, )"
                             R"({"name": "y", "lower": -1, "upper": 1, "step": 0.5})";
  const Abstraction a = test::build(refused_flow(states, R"json("x": "u", "y": "1/(2 + x)")json"));
  EXPECT_TRUE(a.resolved(0, cell_of(a, {0, 2}), 0).blocked);  // u = -1
  EXPECT_FALSE(a.resolved(0, cell_of(a, {1, 2}), 1).blocked);
}

TEST(Stiff, IsSolvedWhereEachStateSettles) {
  const std::string states = R"({"name": "x", "lower": -1, "upper": 1, "step": 0.5}, )"
                             R"({"name": "y", "lower": -1, "upper": 1, "step": 0.5})";
  const Abstraction a = test::build(refused_flow(states, R"json("x": "-1e5*(x - sin(y))", "y": "u")json"));
  // From y in [-0.25, 0.25] with u = 0 to x in sin([-0.25, 0.25]), up to what it has yet to settle.
  EXPECT_EQ(a.raw(0, cell_of(a, {4, 2}), 1), (IndexRange{2, 2}));
}

TEST(Stiff, NamesTheRateWhereItIsRefused) {
  const std::string states = R"({"name": "x", "lower": -1, "upper": 1, "step": 1, "outside": "saturate"}, )"
                             R"({"name": "y", "lower": -1, "upper": 1, "step": 1, "outside": "saturate"})";
  try {
    (void)test::build(refused_flow(states, R"json("x": "-1e9*(x - 3*y)", "y": "-1e9*(y + 3*x) + u")json"));
    FAIL();
  } catch (const SpecError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("too stiff"), std::string::npos) << text;
    EXPECT_NE(text.find("e+09"), std::string::npos) << text;
  }
}

TEST(FarAway, ShiftNearTheLargestIndexIsExactOnARing) {
  const std::string text = R"({"coordreq": 1, "name": "t",
"states": [{"name": "h", "lower": 0, "upper": 0.9, "count": 9, "outside": "periodic"}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"h": "h + 214748364.3 + 0.1*u"}},
"safe": "true", "abstraction": {"cells": "half_open"}})";
  const Abstraction a = test::build(read_system(text, "test"));
  for (std::int64_t k = 0; k < 9; ++k) {
    for (std::int64_t u = 0; u < 2; ++u) {
      const auto next = static_cast<std::int32_t>((k + 2147483643 + u) % 9);
      EXPECT_EQ(a.resolved(0, k, u).inside, (IndexRange{next, next}));
    }
  }
}

TEST(Rings, TanOfPartsOfATurnHasNoPoleBeyondTheSeam) {
  const SystemSpec spec = read_system(R"json({"coordreq": 1, "name": "tan",
"states": [{"name": "y", "lower": "-pi", "upper": "pi", "count": 12, "outside": "periodic"}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 0.7, "equations": {"y": "1 + tan(y/4)^2 + 0*u"}}, "safe": "true"})json",
                                      "tan");
  test::attack(spec, 200);
}

}  // namespace
}  // namespace coordreq

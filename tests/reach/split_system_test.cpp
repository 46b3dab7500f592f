// Cells that are divided, in systems with all that a plant may have: posts, and where asked for tubes, hold
// simulated solutions and are nowhere wider than without.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "reach/attack.hpp"

namespace coordreq {
namespace {

struct Bending {
  const char* name;
  const char* states;
  const char* equations;
  const char* disturbances = "";
  bool between_samples = false;
  bool has_limits = false;
};

const Bending kBending[] = {
    {"a disturbance",
     R"({"name": "x", "lower": -1.5, "upper": 1.5, "step": 0.5}, {"name": "y", "lower": -1.5, "upper": 1.5, "step": 0.5})",
     R"json("x": "y", "y": "2*(1 - x^2)*y - x + u + w")json",
     R"({"name": "w", "lower": -0.25, "upper": 0.25})"},
    {"limits",
     R"({"name": "x", "lower": -1.5, "upper": 1.5, "step": 0.5, "outside": "stop"}, {"name": "y", "lower": -1.5, "upper": 1.5, "step": 0.5, "outside": "stop"})",
     R"json("x": "y", "y": "2*(1 - x^2)*y - x + u")json", "", false, true},
    {"a seam of another period",
     R"({"name": "x", "lower": -1, "upper": 1, "step": 0.25}, {"name": "h", "lower": -1, "upper": 1, "count": 8, "outside": "periodic"})",
     R"json("x": "2*sin(3*x)*sin(2*h)", "h": "0.5*x^2 + 0.25*u")json"},
    {"ways between samples",
     R"({"name": "x", "lower": -1.5, "upper": 1.5, "step": 0.5}, {"name": "y", "lower": -1.5, "upper": 1.5, "step": 0.5})",
     R"json("x": "y", "y": "2*(1 - x^2)*y - x + u")json", "", true},
};

SystemSpec bending(const Bending& one, int effort) {
  return read_system(fmt::format(R"({{"coordreq": 1, "name": "bending", "states": [{}],
"inputs": [{{"name": "u", "values": [0.5]}}], "agents": [{{"name": "a", "inputs": ["u"]}}], "disturbances": [{}],
"dynamics": {{"time": "continuous", "period": 0.8, "equations": {{{}}}}}, "safe": "true",
"abstraction": {{"effort": {}, "between_samples": {}}}}})",
                                 one.states, one.disturbances, one.equations, effort, one.between_samples),
                     "bending");
}

/// Of all posts, in cells.
std::int64_t widths_of_posts(const Abstraction& a) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    for (std::int64_t cell = 0; cell < a.grid.cells(); ++cell) {
      const IndexRange range = a.raw(i, cell, 0);
      sum += std::int64_t{range.last} - range.first;
    }
  }
  return sum;
}

/// On a ring after whole turns.
bool is_part_of(const GridDimension& dimension, IndexRange inner, IndexRange outer) {
  const auto fits = [&](std::int64_t by) {
    return outer.first <= inner.first + by && inner.last + by <= outer.last;
  };
  if (!dimension.periodic()) return fits(0);
  return outer.last - outer.first + 1 >= dimension.count || fits(0) || fits(dimension.count) ||
         fits(-dimension.count);
}

/// A solution on its way, in cells of the range taken as closed.
bool is_in_cells(const GridDimension& dimension, IndexRange range, double value, double slack = 1e-9) {
  const double position = (value - dimension.first.get_d()) / dimension.step.get_d();
  for (int turn = dimension.periodic() ? -3 : 0; turn <= (dimension.periodic() ? 3 : 0); ++turn) {
    const double k = position + turn * static_cast<double>(dimension.count);
    if (range.first - 0.5 - slack <= k && k <= range.last + 0.5 + slack) return true;
  }
  return false;
}

void attack_tubes(const SystemSpec& spec, const Abstraction& a, int cases) {
  std::mt19937_64 random(20180410);
  for (int c = 0; c < cases; ++c) {
    const test::RandomStart start = test::random_start(spec, a, random);
    for (const std::vector<double>& state : test::simulate(spec, start.slots, random)) {
      for (std::size_t i = 0; i < a.grid.size(); ++i)
        ASSERT_TRUE(is_in_cells(a.grid[i], a.raw_tube(i, start.cell, start.input), state[i])) << start.cell;
    }
  }
}

/// In small steps that end at the limits.
void attack_limits(const SystemSpec& spec, const Abstraction& a, int cases) {
  constexpr int kEulerSteps = 8'000;
  std::mt19937_64 random(20180410);
  std::vector<Evaluator<double>> equations(spec.dynamics.equations.begin(), spec.dynamics.equations.end());
  const auto clamped = [&](std::size_t i, double x) {
    const GridDimension& dimension = a.grid[i];
    return std::clamp(x, dimension.first.get_d(), dimension.point(dimension.count - 1).get_d());
  };
  for (int c = 0; c < cases; ++c) {
    test::RandomStart start = test::random_start(spec, a, random);
    for (std::size_t i = 0; i < 2; ++i) start.slots[i] = clamped(i, start.slots[i]);
    for (int k = 0; k < kEulerSteps; ++k) {
      const double rate[] = {equations[0].number(start.slots), equations[1].number(start.slots)};
      for (std::size_t i = 0; i < 2; ++i)
        start.slots[i] = clamped(i, start.slots[i] + 0.8 / kEulerSteps * rate[i]);
    }
    for (std::size_t i = 0; i < 2; ++i)
      ASSERT_TRUE(is_in_cells(a.grid[i], a.raw(i, start.cell, 0), start.slots[i], 0.01)) << start.cell;
  }
}

TEST(SplitSystem, WhateverAPlantHasIsHeldByThePartsOfItsCells) {
  for (const Bending& one : kBending) {
    SCOPED_TRACE(one.name);
    const SystemSpec spec = bending(one, 60);
    const Abstraction divided = test::build(spec);
    const Abstraction whole = test::build(bending(one, 0));
    // Of those with limits these have nothing to gain.
    if (!one.has_limits) {
      EXPECT_LT(widths_of_posts(divided), widths_of_posts(whole));
    }
    for (std::size_t i = 0; i < divided.grid.size(); ++i) {
      for (std::int64_t cell = 0; cell < divided.grid.cells(); ++cell) {
        EXPECT_TRUE(is_part_of(divided.grid[i], divided.raw(i, cell, 0), whole.raw(i, cell, 0))) << cell;
        if (!one.between_samples) continue;
        EXPECT_TRUE(is_part_of(divided.grid[i], divided.raw_tube(i, cell, 0), whole.raw_tube(i, cell, 0)))
            << cell;
      }
    }
    if (one.has_limits) {
      attack_limits(spec, divided, 50);
    } else {
      test::attack(spec, divided, 300);
    }
    if (one.between_samples) attack_tubes(spec, divided, 100);
  }
}

}  // namespace
}  // namespace coordreq

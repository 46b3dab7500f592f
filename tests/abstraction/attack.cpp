#include "abstraction/attack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "abstraction/build_abstraction.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {
namespace {

/// The derivative or next value at a point, in plain doubles.
std::vector<double> right_hand_side(const ProblemSpec& spec, std::vector<double> slots) {
  std::vector<double> result;
  for (const Program& equation : spec.dynamics.equations) {
    Evaluator<double> evaluator(equation);
    result.push_back(evaluator.number(slots));
  }
  return result;
}

/// New values of the disturbances, at their ends more often than not.
template <class Uniform>
void switch_disturbances(const ProblemSpec& spec, const Uniform& uniform, std::vector<double>& slots) {
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    const double lower = spec.disturbances[l].lower.get_d();
    const double upper = spec.disturbances[l].upper.get_d();
    slots[spec.disturbance_slot(l)] = std::clamp(uniform(2 * lower - upper, 2 * upper - lower), lower, upper);
  }
}

/// Classical Runge-Kutta steps; disturbances switch a few times at random.
template <class Uniform>
std::vector<double> simulate(const ProblemSpec& spec, const Uniform& uniform, std::vector<double> slots) {
  switch_disturbances(spec, uniform, slots);
  if (spec.dynamics.time == Time::discrete) return right_hand_side(spec, slots);
  const int steps = 400;
  const double h = spec.dynamics.period.get_d() / steps;
  const std::size_t n = spec.states.size();
  const auto moved = [&](const std::vector<double>& k, double by) {
    std::vector<double> next = slots;
    for (std::size_t i = 0; i < n; ++i) next[i] += by * k[i];
    return next;
  };
  for (int s = 0; s < steps; ++s) {
    if (uniform(0, steps) < 3) switch_disturbances(spec, uniform, slots);
    const auto k1 = right_hand_side(spec, slots);
    const auto k2 = right_hand_side(spec, moved(k1, h / 2));
    const auto k3 = right_hand_side(spec, moved(k2, h / 2));
    const auto k4 = right_hand_side(spec, moved(k3, h));
    for (std::size_t i = 0; i < n; ++i) slots[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  slots.resize(n);
  return slots;
}

/// True if the value lies in the raw range, cells taken as closed; modulo the count where periodic.
bool in_range(const GridDimension& dimension, IndexRange range, double value) {
  const double position = (value - dimension.first.get_d()) / dimension.step.get_d();
  const double slack = 1e-9;  // of the simulation
  for (int turn = dimension.periodic() ? -3 : 0; turn <= (dimension.periodic() ? 3 : 0); ++turn) {
    const double k = position + turn * static_cast<double>(dimension.count);
    if (range.first - 0.5 - slack <= k && k <= range.last + 0.5 + slack) return true;
  }
  return false;
}

}  // namespace

Abstraction build(const ProblemSpec& spec) {
  ThreadTeam team(2);
  return build_abstraction(spec, team);
}

void attack(const ProblemSpec& spec, const Abstraction& a, int cases) {
  std::mt19937_64 random(20180410);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int c = 0; c < cases; ++c) {
    const auto x = std::uniform_int_distribution<std::int64_t>(0, a.grid.cells() - 1)(random);
    const auto u = std::uniform_int_distribution<std::int64_t>(0, a.inputs.count() - 1)(random);
    std::vector<double> slots(spec.slot_count());
    for (std::size_t i = 0; i < a.grid.size(); ++i) {
      const GridDimension& dimension = a.grid[i];
      const double reach = Rational(dimension.radius() + dimension.measurement_error).get_d();
      const double where = c % 3 == 0 ? std::round(uniform(-1, 1)) : uniform(-1, 1);
      slots[i] = dimension.point(a.grid.index(x, i)).get_d() + where * reach;
      const double period = Rational(dimension.upper - dimension.lower).get_d();
      if (dimension.periodic() && slots[i] < dimension.lower.get_d()) slots[i] += period;
      if (dimension.periodic() && slots[i] >= dimension.upper.get_d()) slots[i] -= period;
    }
    for (std::size_t i = 0; i < a.inputs.size(); ++i) {
      slots[spec.input_slot(i)] = a.inputs[i].values[static_cast<std::size_t>(a.inputs.index(u, i))].get_d();
    }
    const std::vector<double> next = simulate(spec, uniform, slots);
    for (std::size_t i = 0; i < a.grid.size(); ++i) {
      ASSERT_TRUE(in_range(a.grid[i], a.raw(i, x, u), next[i]))
          << a.grid[i].name << " = " << next[i] << " from cell " << x << " under input " << u;
    }
  }
}

}  // namespace coordreq

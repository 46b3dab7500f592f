#include "simulated_flow.hpp"

#include <cmath>

#include "expression/evaluate.hpp"

namespace coordreq::test {
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

}  // namespace

std::string spec_text(const std::string& states, const std::string& time, const std::string& equations,
                      const std::string& abstraction) {
  return R"({"coordreq": 1, "name": "t", "states": [)" + states +
         R"(], "inputs": [{"name": "u", "values": [-1, 0, 0.5]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": ")" +
         time + R"(", "period": 0.5, "equations": {)" + equations + R"(}}, "safe": "true", "abstraction": )" +
         abstraction + "}";
}

Abstraction build(const ProblemSpec& spec) {
  ThreadTeam team(2);
  return build_abstraction(spec, team);
}

std::vector<std::vector<double>> simulate(const ProblemSpec& spec, std::vector<double> slots) {
  if (spec.dynamics.time == Time::discrete) return {right_hand_side(spec, slots)};
  const int steps = 400;
  const double h = spec.dynamics.period.get_d() / steps;
  const std::size_t n = spec.states.size();
  const auto moved = [&](const std::vector<double>& k, double by) {
    std::vector<double> next = slots;
    for (std::size_t i = 0; i < n; ++i) next[i] += by * k[i];
    return next;
  };
  std::vector<std::vector<double>> path;
  for (int s = 0; s < steps; ++s) {
    const auto k1 = right_hand_side(spec, slots);
    const auto k2 = right_hand_side(spec, moved(k1, h / 2));
    const auto k3 = right_hand_side(spec, moved(k2, h / 2));
    const auto k4 = right_hand_side(spec, moved(k3, h));
    for (std::size_t i = 0; i < n; ++i) slots[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    path.emplace_back(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(n));
  }
  return path;
}

RandomStart random_start(const ProblemSpec& spec, const Abstraction& a, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  RandomStart start;
  start.cell = std::uniform_int_distribution<std::int64_t>(0, a.grid.cells() - 1)(random);
  start.input = std::uniform_int_distribution<std::int64_t>(0, a.inputs.count() - 1)(random);
  const bool corner = std::uniform_int_distribution<>(0, 2)(random) == 0;
  start.slots.resize(spec.slot_count());
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    const GridDimension& dimension = a.grid[i];
    const double reach = Rational(dimension.radius() + dimension.measurement_error).get_d();
    const double where = corner ? std::round(uniform(-1, 1)) : uniform(-1, 1);
    double& value = start.slots[i];
    value = dimension.point(a.grid.index(start.cell, i)).get_d() + where * reach;
    const double period = Rational(dimension.upper - dimension.lower).get_d();
    if (dimension.periodic() && value < dimension.lower.get_d()) value += period;
    if (dimension.periodic() && value >= dimension.upper.get_d()) value -= period;
  }
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    const auto k = static_cast<std::size_t>(a.inputs.index(start.input, i));
    start.slots[spec.input_slot(i)] = a.inputs[i].values[k].get_d();
  }
  return start;
}

}  // namespace coordreq::test

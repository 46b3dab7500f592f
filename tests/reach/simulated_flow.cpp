#include "reach/simulated_flow.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "expression/evaluate.hpp"
#include "spec/system_spec.hpp"

namespace coordreq::test {
namespace {

/// The derivative or next value at a point, in plain doubles.
std::vector<double> right_hand_side(const SystemSpec& spec, const std::vector<double>& slots) {
  std::vector<double> result;
  for (const Program& equation : spec.dynamics.equations) {
    Evaluator<double> evaluator(equation);
    result.push_back(evaluator.number(slots));
  }
  return result;
}

double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<>(low, high)(random);
}

/// New values of the disturbances, at their ends more often than not.
void draw_disturbances(const SystemSpec& spec, std::mt19937_64& random, std::vector<double>& slots) {
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    const double lower = spec.disturbances[l].lower.get_d();
    const double upper = spec.disturbances[l].upper.get_d();
    slots[spec.disturbance_slot(l)] =
        std::clamp(uniform(2 * lower - upper, 2 * upper - lower, random), lower, upper);
  }
}

/// Solutions of differential equations that see the representatives of periodic states.
class Simulation {
 public:
  Simulation(const SystemSpec& spec, std::vector<double> slots)
      : spec_(spec), slots_(std::move(slots)), turns_(spec.states.size()) {}

  /// Stops at every seam that is passed on the way, to turn the representative there.
  void advance(double duration) {
    std::vector<double> next = stepped(duration);
    while (passes_seam(next)) {
      const double time = time_before_seam(duration);
      slots_ = stepped(time);
      for (std::size_t i = 0; i < turns_.size(); ++i) turns_[i] += side_passed(i, slots_);
      duration -= time;
      next = stepped(duration);
    }
    slots_ = std::move(next);
  }

  void switch_disturbances(std::mt19937_64& random) { draw_disturbances(spec_, random, slots_); }

  [[nodiscard]] std::vector<double> states() const {
    return {slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(turns_.size())};
  }

 private:
  [[nodiscard]] std::vector<double> derivative(std::vector<double> slots) const {
    for (std::size_t i = 0; i < turns_.size(); ++i) slots[i] -= turns_[i] * period(i);
    return right_hand_side(spec_, slots);
  }

  [[nodiscard]] double period(std::size_t i) const {
    return Rational(spec_.states[i].upper - spec_.states[i].lower).get_d();
  }

  /// -1, 0 or 1: on which side the state is out of the turn that it was in.
  [[nodiscard]] int side_passed(std::size_t i, const std::vector<double>& slots) const {
    if (spec_.states[i].below != Outside::periodic) return 0;
    const double value = slots[i] - turns_[i] * period(i);
    return value >= spec_.states[i].upper.get_d() ? 1 : value < spec_.states[i].lower.get_d() ? -1 : 0;
  }

  [[nodiscard]] bool passes_seam(const std::vector<double>& next) const {
    for (std::size_t i = 0; i < turns_.size(); ++i) {
      if (side_passed(i, next) != 0) return true;
    }
    return false;
  }

  /// Up to just beyond the first seam. REQUIRES: one is passed.
  [[nodiscard]] double time_before_seam(double duration) const {
    double before = 0;
    double after = duration;
    for (double middle = after / 2; before < middle && middle < after; middle = (before + after) / 2) {
      (passes_seam(stepped(middle)) ? after : before) = middle;
    }
    return after;
  }

  /// A step of the classical Runge-Kutta method.
  [[nodiscard]] std::vector<double> stepped(double h) const {
    const auto moved = [&](const std::vector<double>& k, double by) {
      std::vector<double> next = slots_;
      for (std::size_t i = 0; i < k.size(); ++i) next[i] += by * k[i];
      return next;
    };
    const auto k1 = derivative(slots_);
    const auto k2 = derivative(moved(k1, h / 2));
    const auto k3 = derivative(moved(k2, h / 2));
    const auto k4 = derivative(moved(k3, h));
    std::vector<double> next = slots_;
    for (std::size_t i = 0; i < k1.size(); ++i) next[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return next;
  }

  const SystemSpec& spec_;
  std::vector<double> slots_;
  std::vector<int> turns_;
};

}  // namespace

std::string spec_text(const std::string& states, const std::string& time, const std::string& equations,
                      const std::string& abstraction) {
  return R"({"coordreq": 1, "name": "t", "states": [)" + states +
         R"(], "inputs": [{"name": "u", "values": [-1, 0, 0.5]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": ")" +
         time + R"(", "period": 0.5, "equations": {)" + equations + R"(}}, "safe": "true", "abstraction": )" +
         abstraction + "}";
}

Abstraction build(const SystemSpec& spec) {
  ThreadTeam team(2);
  return build_abstraction(spec, team);
}

std::vector<std::vector<double>> simulate(const SystemSpec& spec, std::vector<double> slots,
                                          std::mt19937_64& random) {
  draw_disturbances(spec, random, slots);
  if (spec.dynamics.time == Time::discrete) return {right_hand_side(spec, slots)};
  const int steps = 400;
  Simulation simulation(spec, std::move(slots));
  std::vector<std::vector<double>> path;
  for (int s = 0; s < steps; ++s) {
    if (uniform(0, steps, random) < 3) simulation.switch_disturbances(random);
    simulation.advance(spec.dynamics.period.get_d() / steps);
    path.push_back(simulation.states());
  }
  return path;
}

RandomStart random_start(const SystemSpec& spec, const Abstraction& a, std::mt19937_64& random) {
  RandomStart start;
  start.cell = std::uniform_int_distribution<std::int64_t>(0, a.grid.cells() - 1)(random);
  start.input = std::uniform_int_distribution<std::int64_t>(0, a.inputs.count() - 1)(random);
  const bool corner = std::uniform_int_distribution<>(0, 2)(random) == 0;
  start.slots.resize(spec.slot_count());
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    const GridDimension& dimension = a.grid[i];
    const double reach = Rational(dimension.radius() + dimension.measurement_error).get_d();
    const double where = corner ? std::round(uniform(-1, 1, random)) : uniform(-1, 1, random);
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

#include "dynamics/shift.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "dynamics/dual.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

Interval box_of(const Rational& lower, const Rational& upper) {
  return {.lower = lower_double(lower), .upper = upper_double(upper)};
}

bool contains(const std::vector<std::int32_t>& list, std::size_t state) {
  return std::find(list.begin(), list.end(), static_cast<std::int32_t>(state)) != list.end();
}

bool mentions(const Program& program, std::uint32_t slot) {
  const auto used = program.variables();
  return std::binary_search(used.begin(), used.end(), slot);
}

/// Finds r with f = r * x + (what does not depend on x) for an expression f and one of its variables x.
class SlopeFinder {
 public:
  SlopeFinder(const Program& program, std::uint32_t variable) : program_(program), variable_(variable) {}

  /// Nothing if no such r is seen.
  std::optional<Rational> find() {
    for (const Program::Node& node : program_.nodes) slopes_.push_back(slope_of(node));
    return slopes_.back();
  }

 private:
  using Slope = std::optional<Rational>;  ///< of a condition 0 if it does not depend on x

  [[nodiscard]] bool is_constant(std::uint32_t i) const { return program_.nodes[i].op == Operator::constant; }
  [[nodiscard]] const Rational& constant(std::uint32_t i) const {
    return program_.constants[program_.nodes[i].a];
  }

  [[nodiscard]] Slope slope_of(const Program::Node& node) const {
    if (node.op == Operator::constant || node.op == Operator::literal_true ||
        node.op == Operator::literal_false) {
      return Rational(0);
    }
    if (node.op == Operator::variable) return Rational(node.a == variable_ ? 1 : 0);
    const Slope& a = slopes_[node.a];
    if (!a) return std::nullopt;
    if (node.op == Operator::negate) return Rational(-*a);
    if (is_unary_function(node.op) || node.op == Operator::logical_not) return where(*a == 0, 0);
    const Slope& b = slopes_[node.b];
    if (!b) return std::nullopt;
    if (node.op == Operator::if_else) {
      const Slope& c = slopes_[node.c];
      return where(*a == 0 && c && *b == *c, *b);
    }
    if (is_comparison(node.op)) return where(*a == *b, 0);
    return slope_of_pair(node, *a, *b);
  }

  [[nodiscard]] Slope slope_of_pair(const Program::Node& node, const Rational& a, const Rational& b) const {
    switch (node.op) {
      case Operator::add:
        return Rational(a + b);
      case Operator::subtract:
        return Rational(a - b);
      case Operator::minimum:
      case Operator::maximum:
        return where(a == b, a);
      case Operator::multiply:
        if (is_constant(node.a)) return Rational(constant(node.a) * b);
        if (is_constant(node.b)) return Rational(a * constant(node.b));
        break;
      case Operator::divide:
        if (is_constant(node.b) && constant(node.b) != 0) return Rational(a / constant(node.b));
        break;
      default:
        break;
    }
    return where(a == 0 && b == 0, 0);
  }

  static Slope where(bool known, const Rational& slope) { return known ? Slope(slope) : std::nullopt; }

  const Program& program_;
  std::uint32_t variable_;
  std::vector<Slope> slopes_;
};

/// The same found over the domain: the derivative is 1 wherever the state can be.
bool derivative_is_one(const ProblemSpec& spec, std::size_t state) {
  std::vector<Dual> slots(spec.slot_count());
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const Interval range = range_of(spec.states[i]);
    slots[spec.state_slot(i)] = i == state ? Dual::variable(range, 0) : Dual::constant(range);
  }
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    slots[spec.input_slot(i)] = Dual::constant(range_of(spec.inputs[i]));
  }
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec.disturbances[l];
    slots[spec.disturbance_slot(l)] = Dual::constant(box_of(w.lower, w.upper));
  }
  Evaluator<Dual> evaluator(spec.dynamics.equations[state]);
  const Dual& value = evaluator.number(slots);
  const bool smooth = value.jump.lower == 0 && value.jump.upper == 0 && value.total;
  return smooth && value.directions == 1 && value.gradient[0].lower == 1 && value.gradient[0].upper == 1;
}

bool flow_shifts(const ProblemSpec& spec, const Dependencies& dependencies, std::size_t state) {
  const StateSpec& own = spec.states[state];
  if (own.below == Outside::stop || own.above == Outside::stop) return false;
  // A parameter has the equation 0, which mentions nothing.
  return std::none_of(dependencies.moving.begin(), dependencies.moving.end(), [&](std::int32_t j) {
    return mentions(spec.dynamics.equations[at(j)], spec.state_slot(state));
  });
}

}  // namespace

Interval range_of(const StateSpec& state) {
  const Rational reach =
      (state.discrete ? Rational(0) : Rational(state.grid.step / 2)) + state.measurement_error;
  const Rational last =
      state.grid.first + state.grid.step * Rational(static_cast<long>(state.grid.count - 1));
  const Rational lower = std::min(Rational(state.grid.first - reach), state.lower);
  return box_of(lower, std::max(Rational(last + reach), state.upper));
}

Interval range_of(const InputSpec& input) {
  const auto [low, high] = std::minmax_element(input.values.begin(), input.values.end());
  return box_of(*low, *high);
}

bool is_shift(const ProblemSpec& spec, const Dependencies& dependencies, std::size_t state) {
  if (!contains(dependencies.moving, state) && !contains(dependencies.parameters, state)) return false;
  if (spec.dynamics.time == Time::continuous) return flow_shifts(spec, dependencies, state);
  const std::optional<Rational> slope =
      SlopeFinder(spec.dynamics.equations[state], spec.state_slot(state)).find();
  return slope ? *slope == 1 : derivative_is_one(spec, state);
}

}  // namespace coordreq

#include "reach/shift.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/index.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

bool mentions(const Program& program, std::uint32_t slot) {
  const auto used = program.variables();
  return std::binary_search(used.begin(), used.end(), slot);
}

/// Whether the derivative of the next value is 1 all over the domain.
bool derivative_is_one(const SystemSpec& spec, std::size_t state) {
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
    slots[spec.disturbance_slot(l)] = Dual::constant(enclose(w.lower, w.upper));
  }
  Evaluator<Dual> evaluator(spec.dynamics.equations[state]);
  const Dual& value = evaluator.number(slots);
  const bool smooth = value.jump.lower == 0 && value.jump.upper == 0 && value.total;
  return smooth && value.directions == 1 && value.gradient[0].lower == 1 && value.gradient[0].upper == 1;
}

bool flow_shifts(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state) {
  if (spec.states[state].has(Outside::stop)) return false;
  // A parameter has the equation 0, which mentions nothing.
  return std::none_of(dependencies.moving.begin(), dependencies.moving.end(), [&](std::int32_t j) {
    return mentions(spec.dynamics.equations[at(j)], spec.state_slot(state));
  });
}

}  // namespace

Interval range_of(const StateSpec& state) {
  const Rational reach =
      (state.discrete ? Rational(0) : Rational(state.grid.step / 2)) + state.measurement_error;
  const Rational lower = std::min(Rational(state.grid.first - reach), state.lower);
  return enclose(lower, std::max(Rational(state.grid.last() + reach), state.upper));
}

Interval range_of(const InputSpec& input) {
  const auto [low, high] = std::minmax_element(input.values.begin(), input.values.end());
  return enclose(*low, *high);
}

bool has_measured_limit(const StateSpec& state) {
  const bool saturates = state.has(Outside::saturate);
  return saturates && state.measurement_error > 0;
}

bool is_shift(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state) {
  if (!contains(dependencies.moving, state) && !contains(dependencies.parameters, state)) return false;
  if (has_measured_limit(spec.states[state]) || spec.dynamics.update(state) != nullptr) return false;
  if (spec.dynamics.time == Time::continuous) return flow_shifts(spec, dependencies, state);
  const Slope slope = find_slopes(spec.dynamics.equations[state], spec.state_slot(state)).back();
  return slope ? *slope == 1 : derivative_is_one(spec, state);
}

}  // namespace coordreq

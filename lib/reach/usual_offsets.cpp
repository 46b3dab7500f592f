#include "reach/usual_slices.hpp"

#include <algorithm>
#include <cmath>

#include "expression/evaluate.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

Interval middle_cell(const StateSpec& state) {
  const GridSpec& grid = state.grid;
  const Rational centre = grid.first + grid.step * Rational(static_cast<unsigned long>(grid.count / 2));
  const Rational radius = state.discrete ? Rational(0) : Rational(grid.step / 2);
  return enclose(centre - radius, centre + radius);
}

}  // namespace

std::vector<IndexRange> usual_offsets(const SystemSpec& spec) {
  const bool is_discrete = spec.dynamics.time == Time::discrete;
  std::vector<Interval> slots(spec.slot_count());
  for (std::size_t i = 0; i < spec.states.size(); ++i) slots[spec.state_slot(i)] = range_of(spec.states[i]);
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) slots[spec.input_slot(i)] = range_of(spec.inputs[i]);
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i)
    slots[spec.disturbance_slot(i)] = enclose(spec.disturbances[i].lower, spec.disturbances[i].upper);
  std::vector<IndexRange> result;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const GridSpec& grid = spec.states[i].grid;
    std::vector<Interval> arguments = slots;
    // For the equation x + g this is g.
    if (is_discrete) arguments[spec.state_slot(i)] = Interval(0, 0);
    Evaluator<Interval> evaluator(spec.dynamics.equations[i]);
    const Interval moved = evaluator.number(arguments);
    const double scale = (is_discrete ? 1 : nearest_double(spec.dynamics.period)) / nearest_double(grid.step);
    const double most = std::min(static_cast<double>(grid.count), 1e9);
    const auto index = [&](double length) {
      const double steps = length * scale;
      return static_cast<std::int32_t>(std::isnan(steps) ? most : std::clamp(steps, -most, most));
    };
    result.push_back({index(moved.lower) - 1, index(moved.upper) + 1});
  }
  return result;
}

std::vector<std::int32_t> usual_widths(const SystemSpec& spec) {
  const bool is_discrete = spec.dynamics.time == Time::discrete;
  std::vector<Interval> slots(spec.slot_count());
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    slots[spec.state_slot(i)] = middle_cell(spec.states[i]);
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    const std::vector<Rational>& values = spec.inputs[i].values;
    slots[spec.input_slot(i)] = enclose(values[values.size() / 2], values[values.size() / 2]);
  }
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i)
    slots[spec.disturbance_slot(i)] = enclose(spec.disturbances[i].lower, spec.disturbances[i].upper);
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const GridSpec& grid = spec.states[i].grid;
    Evaluator<Interval> evaluator(spec.dynamics.equations[i]);
    const Interval moved = evaluator.number(slots);
    const double length =
        (moved.upper - moved.lower) * (is_discrete ? 1 : nearest_double(spec.dynamics.period));
    const double cells = length / nearest_double(grid.step) + (is_discrete ? 0 : 1);
    const double most = std::min(static_cast<double>(grid.count), 1e9);
    result.push_back(static_cast<std::int32_t>(std::isnan(cells) ? most : std::clamp(cells + 1, 1.0, most)));
  }
  return result;
}

}  // namespace coordreq

#include "reach/usual_offsets.hpp"

#include <algorithm>
#include <cmath>

#include "expression/evaluate.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

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
    std::vector<Interval> own = slots;
    // Of x + g that is g.
    if (is_discrete) own[spec.state_slot(i)] = Interval(0, 0);
    Evaluator<Interval> evaluator(spec.dynamics.equations[i]);
    const Interval moved = evaluator.number(own);
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

}  // namespace coordreq

#include "model/table_shape.hpp"

#include <algorithm>
#include <iterator>

#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

bool is_constant_zero(const Program& program) {
  return program.nodes.back().op == Operator::constant && program.constants[program.nodes.back().a] == 0;
}

/// A discrete state is put in value by value where it does not move between samples; in discrete time always.
bool is_parameter(const SystemSpec& spec, std::size_t state) {
  if (!spec.states[state].discrete) return false;
  return spec.dynamics.time == Time::discrete || is_constant_zero(spec.dynamics.equations[state]);
}

/// Marks every variable of the equations that `state` depends on: its own equation or update where it jumps,
/// the transitive closure where it flows.
std::vector<bool> used_slots(const SystemSpec& spec, std::size_t state) {
  std::vector<bool> used(spec.slot_count(), false);
  if (const UpdateSpec* const update = spec.dynamics.update(state)) {
    for (const std::uint32_t slot : update->variables()) used[slot] = true;
    if (spec.abstraction.between_samples) used[state] = true;  // where it is until the next sample
    return used;
  }
  std::vector<std::size_t> pending = {state};
  if (spec.dynamics.time == Time::continuous) used[state] = true;
  while (!pending.empty()) {
    const std::size_t equation = pending.back();
    pending.pop_back();
    for (const std::uint32_t slot : spec.dynamics.equations[equation].variables()) {
      if (used[slot]) continue;
      used[slot] = true;
      if (spec.dynamics.time == Time::continuous && slot < spec.states.size()) pending.push_back(slot);
    }
  }
  return used;
}

}  // namespace

std::vector<std::int32_t> Dependencies::all_states() const {
  std::vector<std::int32_t> all;
  std::merge(moving.begin(), moving.end(), parameters.begin(), parameters.end(), std::back_inserter(all));
  return all;
}

Dependencies find_dependencies(const SystemSpec& spec, std::size_t state) {
  const std::vector<bool> used = used_slots(spec, state);
  Dependencies result;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!used[spec.state_slot(i)]) continue;
    (is_parameter(spec, i) ? result.parameters : result.moving).push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    if (used[spec.input_slot(i)]) result.inputs.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i) {
    if (used[spec.disturbance_slot(i)]) result.disturbances.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

}  // namespace coordreq

#include "cell/next_states.hpp"

#include <algorithm>

#include "model/sample_reset.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

NextStates::NextStates(const SystemSpec& spec, const Abstraction& abstraction, PointDynamics& dynamics)
    : spec_(&spec),
      abstraction_(&abstraction),
      dynamics_(&dynamics),
      slots_(spec.slot_count()),
      values_(spec.states.size()) {
  for (const GridDimension& dimension : abstraction.grid.dimensions()) {
    axes_.emplace_back(std::vector<GridDimension>{dimension});
  }
}

void NextStates::begin(std::span<const Rational> state, std::span<const Rational> disturbance,
                       std::span<const Rational> error, std::int64_t cell) {
  cell_ = cell;
  for (std::size_t i = 0; i < state.size(); ++i) slots_[spec_->state_slot(i)] = state[i];
  for (std::size_t l = 0; l < disturbance.size(); ++l) {
    slots_[spec_->disturbance_slot(l)] = disturbance[l];
  }
  error_.assign(error.begin(), error.end());
  for (auto& values : values_) values.clear();
}

const NextStates::Value& NextStates::state(std::size_t i, std::int64_t u) {
  const InputSpace& inputs = abstraction_->inputs;
  std::int64_t key = 0;
  for (const std::int32_t j : dynamics_->dependencies(i).inputs) {
    const auto input = static_cast<std::size_t>(j);
    key += inputs.index(u, input) * inputs.stride(input);
  }
  const auto [entry, is_new] = values_[i].try_emplace(key);
  if (!is_new) return entry->second;
  for (const std::int32_t j : dynamics_->dependencies(i).inputs) {
    const auto input = static_cast<std::size_t>(j);
    slots_[spec_->input_slot(input)] = inputs[input].values[static_cast<std::size_t>(inputs.index(u, input))];
  }
  Value& result = entry->second;
  if (const std::optional<Rational> flow = next(i, u)) {
    const GridDimension& dimension = abstraction_->grid[i];
    result.known = true;
    result.value = reset_at_sample(dimension, *flow);
    result.approximate = nearest_double(result.value);
    const Rational measured = result.value + error_[i];
    const Location location = locate(axes_[i], std::span(&measured, 1));
    result.kind = location.kind;
    result.index = location.index.front();
  } else {
    result.followed = dynamics_->followed(i);
  }
  return result;
}

std::optional<Rational> NextStates::next(std::size_t i, std::int64_t u) {
  if (!spec_->dynamics.is_kept(i)) return dynamics_->next(i, slots_);
  return abstraction_->grid[i].point(abstraction_->raw(i, cell_, u).first);
}

bool NextStates::is_known(std::int64_t u) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!state(i, u).known) return false;
  }
  return true;
}

bool NextStates::has_left(std::int64_t u) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Value& value = state(i, u);
    if (value.known && value.kind == Location::Kind::beyond) return true;
  }
  return false;
}

double NextStates::followed(std::int64_t u) {
  double least = 1.0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!state(i, u).known) least = std::min(least, state(i, u).followed);
  }
  return least;
}

NextStates::Place NextStates::place(std::int64_t u) {
  Place result{.cell = 0};
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Value& value = state(i, u);
    result.kind = std::max(result.kind, value.kind);  // what is worst counts
    result.cell += value.index * abstraction_->grid.stride(i);
  }
  if (result.kind != Location::Kind::cell) result.cell = -1;
  return result;
}

}  // namespace coordreq

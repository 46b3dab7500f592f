#include "cell/next_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.hpp"
#include "model/outside.hpp"
#include "model/sample_reset.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

NextStates::NextStates(const SystemSpec& spec, const Abstraction& abstraction, PointDynamics& dynamics)
    : spec_(&spec),
      abstraction_(&abstraction),
      dynamics_(&dynamics),
      slots_(spec.slot_count()),
      doubles_(spec.slot_count()),
      entries_(spec.states.size()) {
  for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
    const GridDimension& dimension = abstraction.grid[i];
    axes_.emplace_back(std::vector<GridDimension>{dimension});
    // A state that a sample resets may be measured in the cell beside the one that it was reset to.
    const bool resets = traits(dimension.below).resets || traits(dimension.above).resets;
    Axis& axis = quick_.emplace_back(Axis{.first = nearest_double(dimension.first),
                                          .step = nearest_double(dimension.step),
                                          .highest = static_cast<double>(dimension.count - 1)});
    axis.is_quick = !dimension.discrete && !dimension.periodic() && !resets && !spec.dynamics.is_kept(i) &&
                    (dimension.first == 0 || std::isnormal(axis.first)) && std::isnormal(axis.step);
  }
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    inputs_.emplace_back(abstraction.inputs, dynamics.dependencies(i).inputs);
    if (abstraction.inputs.count() <= kMostTabulated) inputs_.back().tabulate();
  }
  for (std::size_t i = 0; i < abstraction.inputs.size(); ++i) {
    input_values_.emplace_back();
    for (const Rational& value : abstraction.inputs[i].values)
      input_values_.back().push_back(nearest_double(value));
  }
}

void NextStates::begin(std::span<const Rational> state, std::span<const Rational> disturbance,
                       std::span<const Rational> error, std::int64_t cell) {
  cell_ = cell;
  const auto set = [this](std::uint32_t slot, const Rational& value) {
    slots_[slot] = value;
    doubles_[slot] = nearest_double(value);
  };
  for (std::size_t i = 0; i < state.size(); ++i) set(spec_->state_slot(i), state[i]);
  for (std::size_t l = 0; l < disturbance.size(); ++l) set(spec_->disturbance_slot(l), disturbance[l]);
  error_.assign(error.begin(), error.end());
  for (std::size_t i = 0; i < error_.size(); ++i) quick_[i].error = nearest_double(error_[i]);
  for (auto& entries : entries_) entries.clear();
}

NextStates::Entry& NextStates::entry(std::size_t i, std::int64_t u) {
  const auto [found, is_new] = entries_[i].try_emplace(inputs_[i].action(u));
  Entry& result = found->second;
  if (!is_new) return result;
  for (const std::int32_t j : dynamics_->dependencies(i).inputs) {
    const InputSpace& inputs = abstraction_->inputs;
    const std::size_t number = at(inputs.index(u, at(j)));
    slots_[spec_->input_slot(at(j))] = inputs[at(j)].values[number];
    doubles_[spec_->input_slot(at(j))] = input_values_[at(j)][number];
  }
  if (const std::optional<std::int64_t> index = index_by_estimate(i)) {
    result.value.known = true;
    result.value.kind = Location::Kind::cell;
    result.value.index = *index;
  } else {
    find_exactly(i, u, result.value);
    result.is_exact = true;
  }
  return result;
}

/// The one index that the measured value can have, at the inputs that have been set.
std::optional<std::int64_t> NextStates::index_by_estimate(std::size_t i) {
  const Axis& axis = quick_[i];
  if (!axis.is_quick || (error_[i] != 0 && !std::isnormal(axis.error))) return std::nullopt;
  const std::optional<PointDynamics::Estimate> next = dynamics_->estimate(i, slots_, doubles_);
  if (!next) return std::nullopt;
  // Each operation errs by less than kUnit of its result, and so does each number that replaces a rational.
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  const double measured = next->value + axis.error;
  const double coordinate = (measured - axis.first) / axis.step + 0.5;
  const double size = std::fabs(next->value) + std::fabs(axis.error) + std::fabs(axis.first);
  const double slack =
      2 * (next->error + 4 * kUnit * size) / axis.step + 4 * kUnit * (std::fabs(coordinate) + 1);
  const double lower = std::floor(coordinate - slack);
  if (!std::isfinite(lower) || lower != std::floor(coordinate + slack)) return std::nullopt;
  if (lower < 0 || lower > axis.highest) return std::nullopt;
  return static_cast<std::int64_t>(lower);
}

const NextStates::Value& NextStates::state(std::size_t i, std::int64_t u) {
  Entry& found = entry(i, u);
  if (found.is_exact) return found.value;
  for (const std::int32_t j : dynamics_->dependencies(i).inputs) {
    const InputSpace& inputs = abstraction_->inputs;
    slots_[spec_->input_slot(at(j))] = inputs[at(j)].values[at(inputs.index(u, at(j)))];
  }
  find_exactly(i, u, found.value);
  found.is_exact = true;
  return found.value;
}

/// @pre unchecked: the inputs of the state have been set
void NextStates::find_exactly(std::size_t i, std::int64_t u, Value& result) {
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
}

std::optional<Rational> NextStates::next(std::size_t i, std::int64_t u) {
  if (!spec_->dynamics.is_kept(i)) return dynamics_->next(i, slots_);
  return abstraction_->grid[i].point(abstraction_->raw(i, cell_, u).first);
}

bool NextStates::is_known(std::int64_t u) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!entry(i, u).value.known) return false;
  }
  return true;
}

bool NextStates::has_left(std::int64_t u) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Value& value = entry(i, u).value;
    if (value.known && value.kind == Location::Kind::beyond) return true;
  }
  return false;
}

double NextStates::followed(std::int64_t u) {
  double least = 1.0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!state(i, u).known) least = std::min(least, state(i, u).followed);
  }
  return least;
}

NextStates::CellLocation NextStates::location(std::int64_t u) {
  CellLocation result{.cell = 0};
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Value& value = entry(i, u).value;
    result.kind = std::max(result.kind, value.kind);  // what is worst counts
    result.cell += value.index * abstraction_->grid.stride(i);
  }
  if (result.kind != Location::Kind::cell) result.cell = -1;
  return result;
}

}  // namespace coordreq

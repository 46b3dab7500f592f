#include "abstraction/state_enclosure.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/dual.hpp"
#include "expression/evaluate.hpp"
#include "expression/undefined_reason.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

Interval box_of(const Rational& lower, const Rational& upper) {
  return {.lower = lower_double(lower), .upper = upper_double(upper)};
}

/// All values that a state can have in some cell, measurement errors included.
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

FlowSystem::Limit limit_of(const StateSpec& state) {
  const Rational last =
      state.grid.first + state.grid.step * Rational(static_cast<long>(state.grid.count - 1));
  return {.below = state.below == Outside::stop,
          .above = state.above == Outside::stop,
          .lower = box_of(state.grid.first, state.grid.first),
          .upper = box_of(last, last)};
}

bool mentions(const Program& program, std::uint32_t slot) {
  const auto used = program.variables();
  return std::binary_search(used.begin(), used.end(), slot);
}

}  // namespace

StateEnclosure::StateEnclosure(const ProblemSpec& spec, const Dependencies& dependencies, std::size_t state)
    : spec_(&spec), dependencies_(dependencies), state_(state), slots_(spec.slot_count()) {
  for (const std::int32_t l : dependencies.disturbances) {
    const DisturbanceSpec& w = spec.disturbances[at(l)];
    slots_[spec.disturbance_slot(at(l))] = box_of(w.lower, w.upper);
  }
  if (spec.dynamics.time == Time::discrete) {
    prepare_map();
  } else {
    prepare_flow();
  }
}

void StateEnclosure::prepare_map() {
  std::vector<std::uint32_t> boxes;
  for (const std::int32_t j : dependencies_.moving) boxes.push_back(spec_->state_slot(at(j)));
  for (const std::int32_t l : dependencies_.disturbances) boxes.push_back(spec_->disturbance_slot(at(l)));
  map_.emplace(spec_->dynamics.equations[state_], boxes);
  shifts_ = map_shifts();
  if (shifts_) {
    origin_ = midpoint(range_of(spec_->states[state_]));
    slots_[spec_->state_slot(state_)] = {.lower = origin_, .upper = origin_};
  }
}

/// True if the derivative by the state itself is exactly 1 over the whole domain and all inputs.
bool StateEnclosure::map_shifts() const {
  const auto moving = static_cast<std::int32_t>(state_);
  if (std::find(dependencies_.moving.begin(), dependencies_.moving.end(), moving) ==
      dependencies_.moving.end()) {
    return false;
  }
  std::vector<Dual> slots(slots_.size());
  for (std::size_t i = 0; i < spec_->states.size(); ++i) {
    const Interval range = range_of(spec_->states[i]);
    slots[spec_->state_slot(i)] = i == state_ ? Dual::variable(range, 0) : Dual::constant(range);
  }
  for (std::size_t i = 0; i < spec_->inputs.size(); ++i) {
    slots[spec_->input_slot(i)] = Dual::constant(range_of(spec_->inputs[i]));
  }
  for (std::size_t l = 0; l < spec_->disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec_->disturbances[l];
    slots[spec_->disturbance_slot(l)] = Dual::constant(box_of(w.lower, w.upper));
  }
  Evaluator<Dual> evaluator(spec_->dynamics.equations[state_]);
  const Dual& value = evaluator.number(slots);
  const bool smooth = value.jump.lower == 0 && value.jump.upper == 0 && value.total;
  return smooth && value.directions == 1 && value.gradient[0].lower == 1 && value.gradient[0].upper == 1;
}

void StateEnclosure::prepare_flow() {
  FlowSystem system;
  system.slot_count = spec_->slot_count();
  bool mentioned = false;
  for (const std::int32_t j : dependencies_.moving) {
    if (at(j) == state_) position_ = system.equations.size();
    const Program& equation = spec_->dynamics.equations[at(j)];
    system.equations.push_back(&equation);
    system.state_slots.push_back(spec_->state_slot(at(j)));
    system.stops.push_back(limit_of(spec_->states[at(j)]));
    mentioned = mentioned || mentions(equation, spec_->state_slot(state_));
  }
  for (const std::int32_t l : dependencies_.disturbances) {
    system.disturbance_slots.push_back(spec_->disturbance_slot(at(l)));
  }
  const FlowSystem::Limit& own = system.stops[position_];
  shifts_ = !mentioned && !own.below && !own.above;
  flow_.emplace(std::move(system), lower_double(spec_->dynamics.period),
                upper_double(spec_->dynamics.period));
}

StateEnclosure::Result StateEnclosure::enclose() {
  return map_ ? enclose_map() : enclose_flow();
}

std::string StateEnclosure::reason(const Result& result) const {
  return undefined_reason(spec_->dynamics.equations[result.culprit], undefined_at_);
}

StateEnclosure::Result StateEnclosure::enclose_map() {
  const Interval value = map_->enclose(slots_);
  if (!value.total) {
    undefined_at_ = slots_;
    return {.status = Status::undefined, .culprit = state_};
  }
  if (!shifts_) return {.value = value};
  return {.value = value - Interval{.lower = origin_, .upper = origin_}};
}

StateEnclosure::Result StateEnclosure::enclose_flow() {
  const FlowEnclosure& found = flow_->flow(slots_);
  if (found.status == FlowEnclosure::Status::ok) {
    Interval value = found.end[position_];
    const StateSpec& own = spec_->states[state_];
    const Interval range = limit_of(own).lower;
    // The state stays within its limits; what rounding adds beyond them is dropped.
    if (own.below == Outside::stop) value.lower = std::max(value.lower, range.lower);
    if (own.above == Outside::stop) value.upper = std::min(value.upper, limit_of(own).upper.upper);
    return {.value = value};
  }
  undefined_at_ = found.undefined_at;
  Result result{
      .status = found.status == FlowEnclosure::Status::blows_up ? Status::blows_up : Status::undefined,
      .culprit = at(dependencies_.moving[found.culprit])};
  if (!shifts_ && position_ < found.tube.size()) {
    const StateSpec& own = spec_->states[state_];
    const Interval domain = range_of(own);
    const Interval& tube = found.tube[position_];
    result.left_unsafely = (own.below == Outside::unsafe && tube.lower < domain.lower) ||
                           (own.above == Outside::unsafe && tube.upper > domain.upper);
  }
  return result;
}

}  // namespace coordreq

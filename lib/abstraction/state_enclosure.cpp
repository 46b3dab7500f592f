#include "abstraction/state_enclosure.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/shift.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

Interval box_of(const Rational& lower, const Rational& upper) {
  return {.lower = lower_double(lower), .upper = upper_double(upper)};
}

FlowSystem::Limit limit_of(const StateSpec& state) {
  const Rational last =
      state.grid.first + state.grid.step * Rational(static_cast<long>(state.grid.count - 1));
  return {.below = state.below == Outside::stop,
          .above = state.above == Outside::stop,
          .lower = box_of(state.grid.first, state.grid.first),
          .upper = box_of(last, last)};
}

}  // namespace

StateEnclosure::StateEnclosure(const ProblemSpec& spec, const Dependencies& dependencies, std::size_t state)
    : spec_(&spec),
      dependencies_(dependencies),
      state_(state),
      shifts_(is_shift(spec, dependencies, state)),
      slots_(spec.slot_count()) {
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
  // The grid points of a discrete state need not be doubles, so no middle serves for all.
  if (spec_->states[state_].discrete) shifts_ = false;
  if (shifts_) {
    origin_ = midpoint(range_of(spec_->states[state_]));
    slots_[spec_->state_slot(state_)] = {.lower = origin_, .upper = origin_};
  }
}

void StateEnclosure::prepare_flow() {
  FlowSystem system;
  system.slot_count = spec_->slot_count();
  for (const std::int32_t j : dependencies_.moving) {
    if (at(j) == state_) position_ = system.equations.size();
    system.equations.push_back(&spec_->dynamics.equations[at(j)]);
    system.state_slots.push_back(spec_->state_slot(at(j)));
    system.stops.push_back(limit_of(spec_->states[at(j)]));
  }
  for (const std::int32_t l : dependencies_.disturbances) {
    system.disturbance_slots.push_back(spec_->disturbance_slot(at(l)));
  }
  flow_.emplace(std::move(system), lower_double(spec_->dynamics.period),
                upper_double(spec_->dynamics.period));
}

StateEnclosure::Result StateEnclosure::enclose() {
  return map_ ? enclose_map() : enclose_flow();
}

StateEnclosure::Result StateEnclosure::enclose_map() {
  const Interval value = map_->enclose(slots_);
  if (!value.total) return {.status = Status::undefined, .culprit = state_};
  if (!shifts_) return {.value = value};
  return {.value = value - Interval{.lower = origin_, .upper = origin_}};
}

/// The state stays within its limits; what rounding adds beyond them is dropped.
Interval StateEnclosure::within_limits(Interval value) const {
  const FlowSystem::Limit limit = limit_of(spec_->states[state_]);
  if (limit.below) value.lower = std::max(value.lower, limit.lower.lower);
  if (limit.above) value.upper = std::min(value.upper, limit.upper.upper);
  return value;
}

StateEnclosure::Result StateEnclosure::enclose_flow() {
  const FlowEnclosure& found = flow_->flow(slots_);
  if (found.status == FlowEnclosure::Status::ok) {
    return {.value = within_limits(found.end[position_]),
            .tube = within_limits(found.tube[position_]),
            .drift = found.drift[position_]};
  }
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

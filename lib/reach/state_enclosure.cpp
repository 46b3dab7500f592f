#include "reach/state_enclosure.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "expression/undefined_reason.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

FlowSystem::Limit limit_of(const StateSpec& state) {
  const Rational last =
      state.grid.first + state.grid.step * Rational(static_cast<long>(state.grid.count - 1));
  return {.below = state.below == Outside::stop,
          .above = state.above == Outside::stop,
          .lower = enclose(state.grid.first),
          .upper = enclose(last)};
}

/// The state stays within its limits; what rounding adds beyond them is dropped.
Interval within_limits(const StateSpec& state, Interval value) {
  if (state.below == Outside::stop) value.lower = std::max(value.lower, limit_of(state).lower.lower);
  if (state.above == Outside::stop) value.upper = std::min(value.upper, limit_of(state).upper.upper);
  return value;
}

/// Whether it may have left the domain through an unsafe side.
bool has_left(const StateSpec& state, const Interval& tube) {
  const Interval domain = range_of(state);
  return (state.below == Outside::unsafe && tube.lower < domain.lower) ||
         (state.above == Outside::unsafe && tube.upper > domain.upper);
}

std::optional<Ring> ring_of(const StateSpec& state) {
  if (state.below != Outside::periodic) return std::nullopt;
  return Ring{.lower = state.lower, .upper = state.upper};
}

}  // namespace

StateEnclosure::StateEnclosure(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state)
    : spec_(&spec),
      dependencies_(dependencies),
      state_(state),
      shifts_(is_shift(spec, dependencies, state)),
      slots_(spec.slot_count()) {
  for (const std::int32_t l : dependencies.disturbances) {
    const DisturbanceSpec& w = spec.disturbances[at(l)];
    slots_[spec.disturbance_slot(at(l))] = coordreq::enclose(w.lower, w.upper);
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
    slots_[spec_->state_slot(state_)] = Interval(origin_);
  }
}

void StateEnclosure::prepare_flow() {
  FlowSystem system;
  std::vector<std::optional<Ring>> rings;
  system.slot_count = spec_->slot_count();
  for (const std::int32_t j : dependencies_.moving) {
    system.equations.push_back(&spec_->dynamics.equations[at(j)]);
    system.state_slots.push_back(spec_->state_slot(at(j)));
    system.steps.push_back(nearest_double(spec_->states[at(j)].grid.step));
    system.stops.push_back(limit_of(spec_->states[at(j)]));
    rings.push_back(ring_of(spec_->states[at(j)]));
  }
  for (const std::int32_t l : dependencies_.disturbances) {
    system.disturbance_slots.push_back(spec_->disturbance_slot(at(l)));
  }
  flow_.emplace(std::move(system), rings, lower_double(spec_->dynamics.period),
                upper_double(spec_->dynamics.period));
}

void StateEnclosure::enclose() {
  if (map_) {
    map_value_ = map_->enclose(slots_);
  } else {
    found_ = &flow_->flow(slots_);
  }
}

std::string StateEnclosure::reason(const Result& result) const {
  return undefined_reason(spec_->dynamics.equations[result.culprit], map_ ? slots_ : found_->undefined_at);
}

StateEnclosure::Result StateEnclosure::result(std::size_t state) const {
  return map_ ? result_of_map() : result_of_flow(state);
}

StateEnclosure::Result StateEnclosure::result_of_map() const {
  if (!map_value_.total) return {.status = Status::undefined, .culprit = state_};
  if (!shifts_) return {.value = map_value_};
  return {.value = map_value_ - Interval(origin_)};
}

StateEnclosure::Result StateEnclosure::result_of_flow(std::size_t state) const {
  const StateSpec& own = spec_->states[state];
  const auto place =
      std::find(dependencies_.moving.begin(), dependencies_.moving.end(), static_cast<std::int32_t>(state));
  const auto position = static_cast<std::size_t>(place - dependencies_.moving.begin());
  if (found_->status == FlowEnclosure::Status::ok) {
    return {.value = within_limits(own, found_->end[position]),
            .tube = within_limits(own, found_->tube[position]),
            .drift = found_->drift[position]};
  }
  Result result{
      .status = found_->status, .culprit = at(dependencies_.moving[found_->culprit]), .rate = found_->rate};
  // Without an enclosure a post is everything, which blocks the pair where this state has an unsafe side.
  const bool can_block = own.below == Outside::unsafe || own.above == Outside::unsafe;
  for (std::size_t k = 0; can_block && k < found_->tube.size(); ++k) {
    if (shifts_ && k == position) continue;  // its box is not known
    const StateSpec& other = spec_->states[at(dependencies_.moving[k])];
    result.left_unsafely = result.left_unsafely || has_left(other, found_->tube[k]);
  }
  return result;
}

}  // namespace coordreq

#include "reach/state_enclosure.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/fast_paths.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "expression/undefined_reason.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

FlowSystem::Limit limit_of(const StateSpec& state) {
  return {.below = state.below == Outside::stop,
          .above = state.above == Outside::stop,
          .lower = enclose(state.grid.first),
          .upper = enclose(state.grid.last())};
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

std::int64_t effort_of(const SystemSpec& spec) {
  return fast_paths().divided_boxes ? spec.abstraction.effort : 0;
}

}  // namespace

StateEnclosure::StateEnclosure(const SystemSpec& spec, const Dependencies& dependencies,
                               const std::vector<std::size_t>& states, bool terms)
    : spec_(&spec),
      dependencies_(dependencies),
      state_(states.front()),
      shifts_(is_shift(spec, dependencies, state_)),
      terms_(terms),
      slots_(spec.slot_count()) {
  for (const std::int32_t l : dependencies.disturbances) {
    const DisturbanceSpec& w = spec.disturbances[at(l)];
    slots_[spec.disturbance_slot(at(l))] = coordreq::enclose(w.lower, w.upper);
  }
  if (spec.dynamics.time == Time::discrete) {
    prepare_map();
  } else {
    prepare_flow(states);
  }
}

void StateEnclosure::prepare_map() {
  std::vector<std::uint32_t> boxes;
  std::vector<double> steps(spec_->slot_count());
  for (const std::int32_t j : dependencies_.moving) {
    boxes.push_back(spec_->state_slot(at(j)));
    steps[boxes.back()] = nearest_double(spec_->states[at(j)].grid.step);
  }
  for (const std::int32_t l : dependencies_.disturbances) {
    const DisturbanceSpec& w = spec_->disturbances[at(l)];
    boxes.push_back(spec_->disturbance_slot(at(l)));
    steps[boxes.back()] = std::max(nearest_double(w.upper - w.lower), std::numeric_limits<double>::min());
  }
  // The grid points of a discrete state need not be doubles, so no middle serves for all.
  if (spec_->states[state_].discrete) shifts_ = false;
  if (shifts_) {
    origin_ = midpoint(range_of(spec_->states[state_]));
    slots_[spec_->state_slot(state_)] = Interval(origin_);
  }
  EndCells target = cells_of(state_);
  target.state = 0;
  map_.emplace(spec_->dynamics.equations[state_], boxes, steps, target, effort_of(*spec_));
}

void StateEnclosure::prepare_flow(const std::vector<std::size_t>& states) {
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
  std::vector<EndCells> targets;
  for (const std::size_t state : served(states)) targets.push_back(cells_of(state));
  system.summed = (shifts_ || terms_) && !spec_->abstraction.between_samples;
  PeriodicFlow flow(system, rings, lower_double(spec_->dynamics.period),
                    upper_double(spec_->dynamics.period));
  flow_.emplace(std::move(flow), system, std::move(targets), effort_of(*spec_));
}

/// Whose cells count when a box is divided: all states that one flow serves, whichever are asked for, so that
/// each has the same post alone as with the others.
std::vector<std::size_t> StateEnclosure::served(const std::vector<std::size_t>& states) const {
  if (shifts_ || terms_) return states;
  std::vector<std::size_t> result;
  for (const std::int32_t j : dependencies_.moving) {
    if (find_dependencies(*spec_, at(j)) == dependencies_) result.push_back(at(j));
  }
  return result;
}

/// The cells that measure enclosures of a state, by its position among the states that move.
EndCells StateEnclosure::cells_of(std::size_t state) const {
  const StateSpec& one_state = spec_->states[state];
  const auto found =
      std::find(dependencies_.moving.begin(), dependencies_.moving.end(), static_cast<std::int32_t>(state));
  return {.state = static_cast<std::size_t>(found - dependencies_.moving.begin()),
          .first = nearest_double(one_state.grid.first),
          .step = nearest_double(one_state.grid.step),
          .reach = nearest_double(one_state.measurement_error),
          .placed = !shifts_ && !terms_};
}

void StateEnclosure::enclose() {
  if (map_) {
    map_value_ = map_->enclose(slots_);
  } else {
    found_ = &flow_->flow(slots_);
  }
}

std::string StateEnclosure::reason(const Result& result) const {
  REQUIRES(result.status == Status::undefined);
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
  const StateSpec& one_state = spec_->states[state];
  const auto found =
      std::find(dependencies_.moving.begin(), dependencies_.moving.end(), static_cast<std::int32_t>(state));
  const auto position = static_cast<std::size_t>(found - dependencies_.moving.begin());
  if (found_->status == FlowEnclosure::Status::ok) {
    return {.value = within_limits(one_state, found_->end[position]),
            .tube = within_limits(one_state, found_->tube[position]),
            .drift = found_->drift[position]};
  }
  Result result{
      .status = found_->status, .culprit = at(dependencies_.moving[found_->culprit]), .rate = found_->rate};
  // Without an enclosure a post is everything, which blocks the pair where this state has an unsafe side.
  const bool can_block = one_state.below == Outside::unsafe || one_state.above == Outside::unsafe;
  for (std::size_t k = 0; can_block && k < found_->tube.size(); ++k) {
    if (shifts_ && k == position) continue;  // its box is not known
    const StateSpec& other = spec_->states[at(dependencies_.moving[k])];
    result.left_unsafely = result.left_unsafely || has_left(other, found_->tube[k]);
  }
  return result;
}

}  // namespace coordreq

#include "reach/nominal_flow.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

/// Ticks of a step, of which sub-steps have some; crossing an event costs an error of the order of a tick's
/// square.
constexpr std::uint32_t kNominalTicks = 256;
/// Longer sub-steps are tried again after so many that went well.
constexpr int kNominalPatience = 3;
/// Relative to the magnitude: what a step's remainder may add.
constexpr double kNominalTolerance = 1e-14;

Interval fraction(const Interval& duration, std::uint32_t ticks) {
  return duration *
         Interval{static_cast<double>(ticks) / kNominalTicks, static_cast<double>(ticks) / kNominalTicks};
}

/// Whether the limit that `derivative` points out of is reached within the duration for sure.
bool reaches(const FlowSystem::Limit& limit, const Interval& start, const Interval& derivative,
             const Interval& duration) {
  const Interval least{duration.lower, duration.lower};
  if (limit.above && derivative.lower > 0.0) {
    return (start + least * derivative).lower >= limit.upper.upper;
  }
  if (limit.below && derivative.upper < 0.0) {
    return (start + least * derivative).upper <= limit.lower.lower;
  }
  return false;
}

bool is_held(const FlowSystem::Limit& limit, const Interval& value, const Interval& derivative) {
  const bool at_upper = limit.above && value.lower >= limit.upper.lower;
  const bool at_lower = limit.below && value.upper <= limit.lower.upper;
  return (at_upper && derivative.lower >= 0.0) || (at_lower && derivative.upper <= 0.0);
}

}  // namespace

bool is_free(const FlowSystem::Limit& limit, const Interval& start, const Interval& derivative,
             const Interval& duration) {
  const Interval moved = start + Interval{0.0, duration.upper} * derivative;
  const bool upper = !limit.above || derivative.upper <= 0.0 || moved.upper <= limit.upper.lower;
  const bool lower = !limit.below || derivative.lower >= 0.0 || moved.lower >= limit.lower.upper;
  return upper && lower;
}

NominalFlow::NominalFlow(const FlowTape& tape, VectorField& field)
    : field_(&field),
      tape_(&tape),
      taylor_(tape),
      choices_(tape.nodes.size()),
      box_(tape.outputs.size()),
      derivative_(tape.outputs.size()),
      phases_(tape.outputs.size()),
      held_(tape.outputs.size()),
      tolerance_(tape.outputs.size()) {}

bool NominalFlow::advance(const Interval& duration, const Choices& choices, std::span<const double> tolerance,
                          State& state) {
  choices_ = choices;
  field_->pin(&choices_);
  std::uint32_t left = kNominalTicks;
  std::uint32_t ticks = kNominalTicks;
  int successes = 0;
  while (left > 0) {
    ticks = std::min(ticks, left);
    ++tries_;
    if (try_step(fraction(duration, ticks), ticks == 1, tolerance, state)) {
      left -= ticks;
      if (++successes % kNominalPatience == 0) ticks *= 2;
    } else if (ticks > 1) {
      ticks /= 2;
      successes = 0;
    } else {
      break;
    }
  }
  field_->pin(nullptr);
  return left == 0;
}

bool NominalFlow::try_step(const Interval& duration, bool smallest, std::span<const double> tolerance,
                           State& state) {
  if (field_->enclose_solutions(state.value, duration, box_, derivative_)) return false;
  const bool phases_known = find_phases(duration, state);
  if (decide_kinks(*tape_, field_->values(), choices_) && phases_known) {
    for (std::size_t i = 0; i < box_.size(); ++i) {
      tolerance_[i] = std::max(tolerance[i], kNominalTolerance * box_[i].magnitude());
    }
    taylor_.begin(*field_, choices_, held_);
    taylor_.find_remainder(duration, tolerance_, remainder_);
    if (remainder_.order > 0) {
      taylor_.advance(*field_, duration, choices_, held_, remainder_, state.value);
      release(state);
      return true;
    }
  }
  if (smallest) cross(duration, state);
  return smallest;
}

/// @returns whether no state may run into its limit
bool NominalFlow::find_phases(const Interval& duration, const State& state) {
  if (field_->system().stops.empty()) return true;
  bool known = true;
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const FlowSystem::Limit& limit = field_->system().stops[i];
    phases_[i] = StopPhase::open;
    if (state.at_limit[i] && is_held(limit, state.value[i], derivative_[i])) {
      phases_[i] = StopPhase::held;
    } else if (is_free(limit, state.value[i], derivative_[i], duration)) {
      phases_[i] = StopPhase::free;
    }
    held_[i] = phases_[i] == StopPhase::held;
    known = known && phases_[i] != StopPhase::open;
  }
  return known;
}

/// A step of first order: x + h f(B).
void NominalFlow::cross(const Interval& duration, State& state) {
  for (std::size_t i = 0; i < box_.size(); ++i) {
    if (phases_[i] == StopPhase::held) continue;
    const Interval start = state.value[i];
    state.value[i] = field_->clipped(i, start + duration * derivative_[i]);
    if (phases_[i] != StopPhase::open) continue;
    const FlowSystem::Limit& limit = field_->system().stops[i];
    const bool arrived = reaches(limit, start, derivative_[i], duration);
    if (arrived) state.value[i] = derivative_[i].lower > 0.0 ? limit.upper : limit.lower;
    state.at_limit[i] = arrived;
  }
}

/// States that were free have left their limits.
void NominalFlow::release(State& state) {
  for (std::size_t i = 0; i < box_.size(); ++i) {
    if (phases_[i] == StopPhase::free) state.at_limit[i] = false;
  }
}

}  // namespace coordreq

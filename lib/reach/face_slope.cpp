#include "reach/face_slope.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

/// The box of the disturbances is divided into at most so many subboxes.
constexpr std::size_t kMostSubboxes = 24;
/// Each round gives at least one more variable its sign.
constexpr int kSlopeRounds = 3;
/// Solutions may leave the bounds by no more than this before a contradiction is found.
constexpr double kMargin = 1e-12;

Interval widened(const Interval& a) {
  const double more = kMargin * std::max(std::fabs(a.lower), std::fabs(a.upper)) + 1e-280;
  return {a.lower - more, a.upper + more, a.total};
}

std::vector<std::size_t> mentioned(const Program& equation, const std::vector<std::uint32_t>& slots) {
  const auto used = equation.variables();
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (std::binary_search(used.begin(), used.end(), slots[i])) result.push_back(i);
  }
  return result;
}

}  // namespace

FaceSlope::FaceSlope(const FlowSystem& system, std::size_t state)
    : system_(&system),
      state_(state),
      value_(*system.equations[state]),
      derivative_(*system.equations[state]),
      states_(mentioned(*system.equations[state], system.state_slots)),
      disturbances_(mentioned(*system.equations[state], system.disturbance_slots)),
      slots_(system.slot_count),
      dual_(system.slot_count),
      gradient_(states_.size() + disturbances_.size()),
      at_(states_.size()) {}

void FaceSlope::begin(std::span<const Interval> slots) {
  std::copy(slots.begin(), slots.end(), slots_.begin());
  for (std::size_t s = 0; s < slots.size(); ++s) dual_[s] = Dual::constant(slots[s]);
}

Interval FaceSlope::on_box(std::span<const Interval> box) {
  for (const std::size_t j : states_) slots_[system_->state_slots[j]] = box[j];
  return value_.number(slots_);
}

FaceSlope::Bound FaceSlope::on_face(const MovingBounds& bounds, bool upper, double negligible) {
  subboxes_.resize(1);
  subboxes_.front().disturbance.clear();
  std::vector<Interval> whole;
  for (const std::size_t l : disturbances_) whole.push_back(slots_[system_->disturbance_slots[l]]);
  subboxes_.front().disturbance = whole;
  examine(bounds, upper, subboxes_.front());
  const auto less = [](const Subbox& a, const Subbox& b) {
    return a.bound.start + a.bound.end < b.bound.start + b.bound.end;
  };
  // An equation that is not smooth for some disturbance may be so for others, which is of no use.
  for (;;) {
    const auto top = std::max_element(subboxes_.begin(), subboxes_.end(), less);
    const bool divisible = top->width > negligible && subboxes_.size() < kMostSubboxes;
    if (!top->bound.found || !divisible) break;
    Subbox half = *top;
    const Interval range = half.disturbance[half.widest];
    const double middle = midpoint(range);
    half.disturbance[half.widest].lower = middle;
    top->disturbance[half.widest].upper = middle;
    examine(bounds, upper, *top);
    examine(bounds, upper, half);
    subboxes_.push_back(std::move(half));
  }
  for (std::size_t l = 0; l < whole.size(); ++l) {
    slots_[system_->disturbance_slots[disturbances_[l]]] = whole[l];
  }
  Bound result = std::max_element(subboxes_.begin(), subboxes_.end(), less)->bound;
  for (const Subbox& subbox : subboxes_) {
    result.found = result.found && subbox.bound.found;
    result.start = std::max(result.start, subbox.bound.start);
    result.end = std::max(result.end, subbox.bound.end);
    result.decay = std::min(result.decay, subbox.bound.decay);
  }
  return result;
}

/// The bound for some of the disturbances. Of the states first nothing is known but their box, so that the
/// derivatives that are found then hold between all points of it.
void FaceSlope::examine(const MovingBounds& bounds, bool upper, Subbox& subbox) {
  subbox.bound = {};
  subbox.width = 0.0;
  std::fill(at_.begin(), at_.end(), At::anywhere);
  std::vector<Interval> disturbance = subbox.disturbance;
  for (int round = 0;; ++round) {
    set_states(bounds, upper, false);
    for (std::size_t l = 0; l < disturbances_.size(); ++l) {
      slots_[system_->disturbance_slots[disturbances_[l]]] = subbox.disturbance[l];
    }
    if (!differentiate()) break;
    if (round == kSlopeRounds || !use_signs(upper, subbox)) {
      subbox.bound.found = true;
      break;
    }
  }
  if (subbox.bound.found) {
    const Interval rate = rate_of_change(bounds, upper);
    find_widest(subbox);
    const Interval start = value_at_start(bounds, upper);
    const double duration = bounds.duration;
    subbox.bound.start = outward_end(start, upper);
    subbox.bound.end =
        outward::add_up(subbox.bound.start, outward_end(Interval{duration, duration} * rate, upper));
    subbox.bound.least = std::min(subbox.bound.start, subbox.bound.end);
    subbox.bound.spread = duration * (rate.upper - rate.lower);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      if (states_[k] == state_) subbox.bound.decay = gradient_[k].lower;
    }
    subbox.bound.found = start.total && start.is_finite() && rate.is_finite();
  }
  subbox.disturbance = std::move(disturbance);
}

void FaceSlope::set_states(const MovingBounds& bounds, bool upper, bool at_start) {
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const std::size_t j = states_[k];
    const bool at_upper = j == state_ ? upper : at_[k] == At::upper;
    const bool at_lower = j == state_ ? !upper : at_[k] == At::lower;
    Interval& slot = slots_[system_->state_slots[j]];
    if (at_upper || at_lower) {
      const MovingEnd& end = at_upper ? bounds.upper[j] : bounds.lower[j];
      slot = at_start ? Interval(end.start) : widened(end.during(bounds.duration));
    } else {
      slot = at_start ? Interval{bounds.lower[j].start, bounds.upper[j].start} : bounds.box[j];
    }
  }
}

/// The gradient over what is in the slots. @returns whether the equation is defined and smooth enough there
bool FaceSlope::differentiate() {
  const auto slot_of = [&](std::size_t k) {
    return k < states_.size() ? system_->state_slots[states_[k]]
                              : system_->disturbance_slots[disturbances_[k - states_.size()]];
  };
  for (std::size_t k = 0; k < gradient_.size(); ++k) dual_[slot_of(k)] = Dual::constant(slots_[slot_of(k)]);
  for (std::size_t first = 0; first < gradient_.size(); first += Dual::kDirections) {
    const std::size_t count = std::min(Dual::kDirections, gradient_.size() - first);
    for (std::size_t d = 0; d < count; ++d) {
      dual_[slot_of(first + d)] = Dual::variable(slots_[slot_of(first + d)], d);
    }
    const Dual& value = derivative_.number(dual_);
    if (!value.total || !value.value.total || value.jump.upper > 0.0) return false;
    for (std::size_t d = 0; d < count; ++d) {
      gradient_[first + d] = d < value.directions ? value.gradient[d] : Interval{0.0, 0.0};
      if (!gradient_[first + d].is_finite()) return false;
      dual_[slot_of(first + d)] = Dual::constant(slots_[slot_of(first + d)]);
    }
  }
  return true;
}

/// Puts variables with a derivative of proven sign where the extreme is. @returns whether there are new ones
bool FaceSlope::use_signs(bool upper, Subbox& subbox) {
  bool any = false;
  const auto keeps_sign = [](const Interval& a) { return a.lower >= 0.0 || a.upper <= 0.0; };
  for (std::size_t k = 0; k < states_.size(); ++k) {
    if (states_[k] == state_ || at_[k] != At::anywhere || !keeps_sign(gradient_[k])) continue;
    at_[k] = (gradient_[k].lower >= 0.0) == upper ? At::upper : At::lower;
    any = true;
  }
  for (std::size_t l = 0; l < disturbances_.size(); ++l) {
    const Interval& gradient = gradient_[states_.size() + l];
    Interval& range = subbox.disturbance[l];
    if (range.is_point() || !keeps_sign(gradient)) continue;
    range = Interval((gradient.lower >= 0.0) == upper ? range.upper : range.lower);
    any = true;
  }
  return any;
}

/// By intervals and by the mean value form, with the gradient over the whole step.
Interval FaceSlope::value_at_start(const MovingBounds& bounds, bool upper) {
  set_states(bounds, upper, true);
  const Interval natural = value_.number(slots_);
  const auto slot_of = [&](std::size_t k) {
    return k < states_.size() ? system_->state_slots[states_[k]]
                              : system_->disturbance_slots[disturbances_[k - states_.size()]];
  };
  Interval spread{0.0, 0.0};
  for (std::size_t k = 0; k < gradient_.size(); ++k) {
    Interval& slot = slots_[slot_of(k)];
    if (slot.is_point()) continue;
    const Interval middle = Interval(midpoint(slot));
    spread = spread + gradient_[k] * (slot - middle);
    slot = middle;
  }
  if (spread.is_point()) return natural;
  const Interval by_mean = value_.number(slots_) + spread;
  return intersect(natural, by_mean).value_or(natural);
}

/// The rate of change of the extreme as the face moves. Its position is known along monotone variables; along
/// others it is compared with the nearest point of its last position.
Interval FaceSlope::rate_of_change(const MovingBounds& bounds, bool upper) const {
  Interval sum{0.0, 0.0};
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const std::size_t j = states_[k];
    const bool at_upper = j == state_ ? upper : at_[k] == At::upper;
    const bool at_lower = j == state_ ? !upper : at_[k] == At::lower;
    if (at_upper || at_lower) {
      sum = sum + gradient_[k] * (at_upper ? bounds.upper[j].rate : bounds.lower[j].rate);
    } else {
      sum = sum + gradient_[k] * Interval{std::min(bounds.lower[j].rate.lower, 0.0),
                                          std::max(bounds.upper[j].rate.upper, 0.0)};
    }
  }
  return sum;
}

void FaceSlope::find_widest(Subbox& subbox) const {
  for (std::size_t l = 0; l < disturbances_.size(); ++l) {
    const Interval& range = subbox.disturbance[l];
    if (range.is_point()) continue;
    const Interval& gradient = gradient_[states_.size() + l];
    const double width = (range.upper - range.lower) * std::max(-gradient.lower, gradient.upper);
    if (width <= subbox.width) continue;
    subbox.width = width;
    subbox.widest = l;
  }
}

}  // namespace coordreq

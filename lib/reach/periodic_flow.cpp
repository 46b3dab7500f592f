#include "reach/periodic_flow.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

/// Rounding errors of so many periods still do no harm.
constexpr std::int64_t kVeryManyTurns = 1000000;

bool is_mentioned(const FlowSystem& system, std::uint32_t slot) {
  return std::any_of(system.equations.begin(), system.equations.end(), [&](const Program* equation) {
    const auto used = equation->variables();
    return std::binary_search(used.begin(), used.end(), slot);
  });
}

Rational period_of(const Ring& ring) {
  return ring.upper - ring.lower;
}

}  // namespace

PeriodicFlow::PeriodicFlow(FlowSystem system, const std::vector<std::optional<Ring>>& rings, double tau_lower,
                           double tau_upper)
    : period_(tau_upper), plain_(system, tau_lower, tau_upper) {
  find_windings(system, rings);
  slots_.resize(system.slot_count + 2 * windings_.size());
  if (windings_.empty()) return;
  const Interval period{tau_lower, tau_upper};
  followed_.emplace(wind_system(system, Representative::followed, period));
  anywhere_.emplace(wind_system(system, Representative::anywhere, period));
}

void PeriodicFlow::find_windings(const FlowSystem& system, const std::vector<std::optional<Ring>>& rings) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (!rings[i] || !is_mentioned(system, system.state_slots[i])) continue;
    const auto first = static_cast<std::uint32_t>(system.slot_count + 2 * windings_.size());
    windings_.push_back({.state = i, .ring = *rings[i], .slots = {.error = first, .anywhere = first + 1}});
  }
}

PeriodicFlow::Wound PeriodicFlow::wind_system(const FlowSystem& system, Representative representative,
                                              const Interval& period) {
  std::vector<Program> equations;
  for (const Program* equation : system.equations) equations.push_back(*equation);
  FlowSystem wound = system;
  wound.slot_count = slots_.size();
  wound.seams.resize(equations.size());
  for (Winding& winding : windings_) {
    for (Program& equation : equations) {
      WoundEquation next =
          wind(equation, system.state_slots[winding.state], winding.ring, winding.slots, representative);
      winding.as_number = winding.as_number || next.as_number;
      winding.mismatch = std::max(winding.mismatch, next.mismatch);
      equation = std::move(next.program);
    }
    if (winding.mismatch > 0) wound.disturbance_slots.push_back(winding.slots.error);
    if (!winding.as_number) continue;
    if (representative == Representative::anywhere) {
      wound.disturbance_slots.push_back(winding.slots.anywhere);
      continue;
    }
    for (int k = -kMostTurns; k <= kMostTurns + 1; ++k) {
      wound.seams[winding.state].push_back(enclose(winding.ring.lower + k * period_of(winding.ring)));
    }
  }
  const auto shared = std::make_shared<const std::vector<Program>>(std::move(equations));
  for (std::size_t i = 0; i < shared->size(); ++i) wound.equations[i] = &(*shared)[i];
  return {shared, ValidatedFlow(std::move(wound), period.lower, period.upper)};
}

const FlowEnclosure& PeriodicFlow::flow(std::span<const Interval> slots) {
  return flow(slots, Kind::whole);
}

const FlowEnclosure& PeriodicFlow::flow_of_subbox(std::span<const Interval> slots, bool long_steps) {
  return flow(slots, long_steps ? Kind::subbox_in_long_steps : Kind::subbox);
}

std::int64_t PeriodicFlow::extra_steps() const {
  const std::int64_t wound =
      windings_.empty() ? 0 : followed_->flow.extra_steps() + anywhere_->flow.extra_steps();
  return plain_.extra_steps() + wound;
}

std::int64_t PeriodicFlow::steps() const {
  const std::int64_t wound = windings_.empty() ? 0 : followed_->flow.steps() + anywhere_->flow.steps();
  return plain_.steps() + wound;
}

bool PeriodicFlow::keeps_apart(std::span<const Interval> box) {
  const bool inside = std::all_of(windings_.begin(), windings_.end(), [&](const Winding& winding) {
    const Interval& range = box[winding.state];
    return range.lower >= upper_double(winding.ring.lower) && range.upper < lower_double(winding.ring.upper);
  });
  return inside && plain_.keeps_apart(box);
}

const FlowEnclosure& PeriodicFlow::flow(std::span<const Interval> slots, Kind kind) {
  const auto enclose = [kind](ValidatedFlow& flow, std::span<const Interval> boxes) -> const FlowEnclosure& {
    return kind == Kind::whole ? flow.flow(boxes)
                               : flow.flow_of_subbox(boxes, kind == Kind::subbox_in_long_steps);
  };
  const FlowEnclosure& plain = enclose(plain_, slots);
  if (windings_.empty() || stays(plain)) return plain;
  std::copy(slots.begin(), slots.end(), slots_.begin());
  for (Winding& winding : windings_) {
    const bool by_plain = !winding.as_number && plain.status == FlowEnclosure::Status::ok;
    allow_for(by_plain ? turns_of(winding, plain) + 1 : kMostTurns, winding);
  }
  const FlowEnclosure& followed = enclose(followed_->flow, slots_);
  if (!find_excess(followed)) return followed;
  for (Winding& winding : windings_) allow_for(kVeryManyTurns, winding);
  const FlowEnclosure& anywhere = enclose(anywhere_->flow, slots_);
  const std::optional<std::size_t> excess = find_excess(anywhere);
  if (!excess) return anywhere;
  failure_ = {.status = FlowEnclosure::Status::blows_up, .culprit = *excess};
  return failure_;
}

/// Whether no state can be at its seam after the start. What only falls does not get to its upper end, which
/// it does not start from.
bool PeriodicFlow::stays(const FlowEnclosure& plain) const {
  if (plain.status != FlowEnclosure::Status::ok) return false;
  return std::all_of(windings_.begin(), windings_.end(), [&](const Winding& winding) {
    const Interval& tube = plain.tube[winding.state];
    const Interval& drift = plain.drift[winding.state];
    return (drift.lower >= 0.0 || tube.lower >= upper_double(winding.ring.lower)) &&
           (drift.upper <= 0.0 || tube.upper < lower_double(winding.ring.upper));
  });
}

/// Sets the boxes of the new variables.
void PeriodicFlow::allow_for(std::int64_t turns, Winding& winding) {
  winding.turns = turns;
  const double error = upper_double(Rational(static_cast<long>(turns)) * winding.mismatch);
  slots_[winding.slots.error] = {-error, error};
  slots_[winding.slots.anywhere] = {lower_double(winding.ring.lower), upper_double(winding.ring.upper)};
}

/// The number of periods that a state is beyond its ring at most; the upper end of a period is in the next
/// one.
std::int64_t PeriodicFlow::turns_of(const Winding& winding, const FlowEnclosure& found) {
  const Interval& tube = found.tube[winding.state];
  if (!std::isfinite(tube.lower) || !std::isfinite(tube.upper)) return kVeryManyTurns + 1;
  const Rational above = exact(tube.upper) - winding.ring.upper;
  const Rational below = winding.ring.lower - exact(tube.lower);
  const Rational turns = std::max(above, below) / period_of(winding.ring);
  if (turns > kVeryManyTurns) return kVeryManyTurns + 1;
  return turns < 0 ? 0 : floor_to_int(turns) + 1;
}

/// A state that winds more often than is allowed for.
std::optional<std::size_t> PeriodicFlow::find_excess(const FlowEnclosure& found) const {
  for (const Winding& winding : windings_) {
    if (turns_of(winding, found) > winding.turns) return winding.state;
  }
  return std::nullopt;
}

}  // namespace coordreq

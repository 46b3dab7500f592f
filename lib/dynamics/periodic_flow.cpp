#include "dynamics/periodic_flow.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

bool is_mentioned(const FlowSystem& system, std::uint32_t slot) {
  return std::any_of(system.equations.begin(), system.equations.end(), [&](const Program* equation) {
    const auto used = equation->variables();
    return std::binary_search(used.begin(), used.end(), slot);
  });
}

Rational period_of(const Ring& ring) {
  return ring.upper - ring.lower;
}

/// By how many periods a state leaves its ring at most, and one more.
int turns_allowed(const Ring& ring, const Interval& tube) {
  const double period = lower_double(period_of(ring));
  const double beyond =
      std::max(tube.upper - lower_double(ring.upper), upper_double(ring.lower) - tube.lower);
  constexpr double kMost = 1e6;  // far more has no enclosure that says anything
  return 1 + static_cast<int>(std::min(std::ceil(std::max(beyond / period, 0.0)), kMost));
}

}  // namespace

PeriodicFlow::PeriodicFlow(FlowSystem system, const std::vector<std::optional<Ring>>& rings, double tau_lower,
                           double tau_upper)
    : plain_(system, tau_lower, tau_upper) {
  wind_equations(system, rings);
  if (!windings_.empty()) wound_.emplace(wound_system(system), tau_lower, tau_upper);
}

void PeriodicFlow::wind_equations(const FlowSystem& system, const std::vector<std::optional<Ring>>& rings) {
  std::vector<Program> equations;
  for (const Program* equation : system.equations) equations.push_back(*equation);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (!rings[i] || !is_mentioned(system, system.state_slots[i])) continue;
    Winding winding{.state = i, .ring = *rings[i]};
    winding.error_slot = static_cast<std::uint32_t>(system.slot_count + windings_.size());
    for (Program& equation : equations) {
      WoundEquation wound = wind(equation, system.state_slots[i], winding.ring, winding.error_slot);
      winding.as_number = winding.as_number || wound.as_number;
      winding.mismatch = std::max(winding.mismatch, wound.mismatch);
      equation = std::move(wound.program);
    }
    windings_.push_back(std::move(winding));
  }
  slots_.resize(system.slot_count + windings_.size());
  equations_ = std::make_shared<const std::vector<Program>>(std::move(equations));
}

FlowSystem PeriodicFlow::wound_system(const FlowSystem& system) const {
  FlowSystem wound = system;
  wound.slot_count = slots_.size();
  wound.seams.resize(system.equations.size());
  for (std::size_t i = 0; i < equations_->size(); ++i) wound.equations[i] = &(*equations_)[i];
  for (const Winding& winding : windings_) {
    if (winding.mismatch > 0) wound.disturbance_slots.push_back(winding.error_slot);
    if (!winding.as_number) continue;
    for (int k = -kMostTurns; k <= kMostTurns + 1; ++k) {
      wound.seams[winding.state].push_back(enclose(winding.ring.lower + k * period_of(winding.ring)));
    }
  }
  return wound;
}

const FlowEnclosure& PeriodicFlow::flow(std::span<const Interval> slots) {
  const FlowEnclosure& plain = plain_.flow(slots);
  if (windings_.empty() || stays(plain)) return plain;
  std::copy(slots.begin(), slots.end(), slots_.begin());
  allow_for_turns(plain);
  const FlowEnclosure& wound = wound_->flow(slots_);
  for (const Winding& winding : windings_) {
    if (is_within(winding, wound.tube[winding.state])) continue;
    failure_.status = FlowEnclosure::Status::winds;
    failure_.culprit = winding.state;
    return failure_;
  }
  return wound;
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

void PeriodicFlow::allow_for_turns(const FlowEnclosure& plain) {
  for (Winding& winding : windings_) {
    const bool by_plain = !winding.as_number && plain.status == FlowEnclosure::Status::ok;
    winding.turns = by_plain ? turns_allowed(winding.ring, plain.tube[winding.state]) : kMostTurns;
    const double error = upper_double(winding.turns * winding.mismatch);
    slots_[winding.error_slot] = {-error, error};
  }
}

bool PeriodicFlow::is_within(const Winding& winding, const Interval& tube) {
  const Rational reach = winding.turns * period_of(winding.ring);
  return tube.lower >= upper_double(winding.ring.lower - reach) &&
         tube.upper < lower_double(winding.ring.upper + reach);
}

}  // namespace coordreq

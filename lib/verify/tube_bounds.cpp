#include "verify/tube_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

bool keeps_its_sign(const Interval& a) {
  return a.lower >= 0.0 || a.upper <= 0.0;
}

bool is_zero(const Interval& a) {
  return a.lower == 0.0 && a.upper == 0.0;
}

Interval between(const FlowBounds::Ends& ends) {
  return {ends.least.lower, ends.greatest.upper};
}

/// Both rise, or both fall, or one of them stands still.
bool goes_on(const Interval& a, const Interval& b) {
  return (a.lower >= 0.0 && b.lower >= 0.0) || (a.upper <= 0.0 && b.upper <= 0.0);
}

}  // namespace

std::optional<FlowTube> TubeBounds::over(const std::vector<Interval>& slots, int parts, int halvings) {
  const std::optional<FlowBounds::Motion> motion = whole_.motion(slots, parts);
  if (!motion) return std::nullopt;
  const Interval start = slots[spec_->state_slot(state_)];
  parts_ = parts;
  halvings_ = halvings;
  at_ = 0;
  now_ = {{start.lower, start.lower}, {start.upper, start.upper}};
  FlowTube tube{.values = start, .beyond = {0.0, 0.0}};
  for (int begin = 0, end = 0; begin < parts; begin = end) {
    const auto slope_of = [&](int part) { return motion->slope[static_cast<std::size_t>(part)]; };
    Interval slope = slope_of(begin);
    end = begin + 1;
    while (end < parts && keeps_its_sign(slope) && goes_on(slope, slope_of(end)))
      slope = hull(slope, slope_of(end++));
    if (!visit_run(slots, begin, end, slope, tube)) return std::nullopt;
  }
  if (motion->stays_above_start) tube.values.lower = start.lower;
  if (motion->stays_above_start) tube.beyond.lower = 0.0;
  if (motion->stays_below_start) tube.values.upper = start.upper;
  if (motion->stays_below_start) tube.beyond.upper = 0.0;
  const auto is_finite = [](const Interval& a) { return std::isfinite(a.lower) && std::isfinite(a.upper); };
  if (!is_finite(tube.values) || !is_finite(tube.beyond)) return std::nullopt;
  return tube;
}

/// Parts begin, ..., end - 1: more than one if the derivative keeps its sign.
bool TubeBounds::visit_run(const std::vector<Interval>& slots, int begin, int end, const Interval& slope,
                           FlowTube& tube) {
  if (!go_to(slots, begin)) return false;
  const Interval before = between(now_);
  tube.values = hull(tube.values, before);
  const Interval part = enclose(spec_->dynamics.period) / Interval{double(parts_), double(parts_)};
  const Interval time{0.0, (part * Interval{double(end - begin), double(end - begin)}).upper};
  const Interval change = is_zero(slope) ? slope : time * slope;
  const bool one_way = keeps_its_sign(slope);
  if (!is_zero(slope)) {
    if (!one_way) tube.values = hull(tube.values, before + change);
    if (!go_to(slots, end)) return false;
    if (one_way) tube.values = hull(tube.values, between(now_));
    tube.low = std::min(tube.low, now_.least.upper);
    tube.high = std::max(tube.high, now_.greatest.lower);
  }
  tube.beyond = {slope.lower >= 0.0 ? tube.beyond.lower : (tube.beyond + change).lower,
                 slope.upper <= 0.0 ? tube.beyond.upper : (tube.beyond + change).upper};
  return true;
}

/// Bounds at the beginning of a part.
bool TubeBounds::go_to(const std::vector<Interval>& slots, int part) {
  if (part == at_) return true;
  const Rational duration = spec_->dynamics.period * Rational(static_cast<long>(part)) / parts_;
  auto known = until_.find(duration);
  if (known == until_.end())
    known = until_.try_emplace(duration, *spec_, *influences_, state_, duration).first;
  const std::optional<FlowBounds::Ends> ends = known->second.ends(slots, halvings_);
  if (!ends) return false;
  at_ = part;
  now_ = *ends;
  return true;
}

}  // namespace coordreq

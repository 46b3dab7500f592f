#include "reach/point_flow.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/outward.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

using outward::kInfinity;

/// Shares of the period: sub-steps are no shorter, after kMostEvaluations of them no shorter than the second.
constexpr double kSmallestStep = 0x1p-36;
constexpr double kSlidingStep = 0x1p-10;
constexpr int kMostEvaluations = 200'000;
/// A sub-step is bounded by stability where DormandPrince::stiffness() is above this; after so many of them
/// the period is stiff.
constexpr double kStable = 2.0;
constexpr int kStiffSteps = 1000;
/// An interpolant is looked at in so many places.
constexpr int kLooks = 8;
/// The precision of the time of an event, as a part of a sub-step.
constexpr double kEventShare = 0x1p-50;
/// After so many events that come within this share of the period, none is looked for earlier, nor before a
/// state has moved by this part of its grid step.
constexpr int kShortEvents = 50;
constexpr double kDwell = 0x1p-12;
constexpr double kDwellOfStep = 0x1p-6;

/// The length of the next sub-step relative to this one, by the error estimate.
double growth(double error, double largest) {
  return error > 0.0 ? std::clamp(0.9 * std::pow(error, -0.2), 0.2, largest) : largest;
}

}  // namespace

PointFlow::PointFlow(const SystemSpec& spec, std::span<const std::int32_t> moving, double tolerance, int most)
    : period_(nearest_double(spec.dynamics.period)),
      tolerance_(tolerance),
      most_(most),
      pair_(moving.size()),
      x_(static_cast<Eigen::Index>(moving.size())),
      point_(x_.size()),
      turned_(moving.size()),
      held_(moving.size()) {
  std::vector<bool> used(spec.slot_count(), false);
  for (const std::int32_t j : moving) {
    const Program& equation = spec.dynamics.equations[static_cast<std::size_t>(j)];
    for (const std::uint32_t slot : equation.variables()) used[slot] = true;
    equations_.emplace_back(equation);
    has_events_ = has_events_ || equations_.back().has_switches();
  }
  for (const std::int32_t j : moving) {
    const auto i = static_cast<std::size_t>(j);
    slots_of_states_.push_back(spec.state_slot(i));
    ranges_.push_back(range_of(spec.states[i], used[spec.state_slot(i)]));
    scale_.push_back(nearest_double(spec.states[i].grid.step));
    has_events_ = has_events_ || ranges_.back().lower > -kInfinity || ranges_.back().upper < kInfinity;
  }
}

PointFlow::Range PointFlow::range_of(const StateSpec& state, bool is_used) {
  if (state.above == Outside::periodic) {
    if (!is_used) return {-kInfinity, kInfinity, false};
    return {nearest_double(state.lower), nearest_double(state.upper), true};
  }
  return {state.below == Outside::stop ? nearest_double(state.grid.first) : -kInfinity,
          state.above == Outside::stop ? nearest_double(state.grid.last()) : kInfinity, false};
}

void PointFlow::put(const Values& x) {
  for (std::size_t i = 0; i < slots_of_states_.size(); ++i) {
    slots_[slots_of_states_[i]] = x(static_cast<Eigen::Index>(i));
  }
}

/// Beyond an event f is what it would be without, unless that is undefined.
void PointFlow::derivative(const Values& x, Values& result) {
  put(x);
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    result(static_cast<Eigen::Index>(i)) = held_[i] != 0 ? 0.0 : equations_[i].kept(slots_);
  }
  if (!has_events_ || result.allFinite()) return;
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    double& value = slots_[slots_of_states_[i]];
    value = std::clamp(value, ranges_[i].lower, ranges_[i].upper);
  }
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    if (held_[i] == 0) result(static_cast<Eigen::Index>(i)) = equations_[i].actual(slots_);
  }
}

/// Goes on to the other side of all events that have been reached.
void PointFlow::settle() {
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const Range& range = ranges_[i];
    double& value = x_(static_cast<Eigen::Index>(i));
    if (value >= range.lower && value <= range.upper) continue;
    if (range.wraps) {
      const double length = range.upper - range.lower;
      const double turns = std::floor((value - range.lower) / length) * length;
      turned_[i] += turns;
      value -= turns;
    }
    value = std::clamp(value, range.lower, range.upper);
  }
  put(x_);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const double rate = equations_[i].settle(slots_);
    const double value = x_(static_cast<Eigen::Index>(i));
    held_[i] = 0;
    if (ranges_[i].wraps) continue;
    if (value == ranges_[i].upper && rate > 0.0) held_[i] = 1;
    if (value == ranges_[i].lower && rate < 0.0) held_[i] = -1;
  }
}

/// The estimated error of the sub-step in units of what is tolerated.
double PointFlow::relative_error() const {
  const Values error = pair_.error();
  double worst = 0.0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double scale = std::max(std::fabs(x_(i)), scale_[static_cast<std::size_t>(i)]);
    const double ratio = std::fabs(error(i)) / (tolerance_ * scale);
    if (!std::isfinite(pair_.end()(i)) || !std::isfinite(ratio)) return kInfinity;
    worst = std::max(worst, ratio);
  }
  return worst;
}

/// Whether by this share of the sub-step a limit or a seam was passed, a switch should have changed sides, or
/// a state should have left its limit.
bool PointFlow::is_event(double share) {
  interpolate(share, point_);
  put(point_);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const double value = point_(static_cast<Eigen::Index>(i));
    if (value < ranges_[i].lower || value > ranges_[i].upper) return true;
    const double rate = equations_[i].kept(slots_);
    if (equations_[i].left_its_sides() || rate * held_[i] < 0.0) return true;
  }
  return false;
}

/// For how long a solution that slides may go on beyond an event.
double PointFlow::dwell() {
  double longest = kDwell * period_;
  put(x_);
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    const double speed = held_[i] != 0 ? 0.0 : std::fabs(equations_[i].kept(slots_));
    if (speed * longest > kDwellOfStep * scale_[i]) longest = kDwellOfStep * scale_[i] / speed;
  }
  return longest;
}

bool PointFlow::is_sliding() const {
  return short_events_ >= kShortEvents;
}

/// The share of the sub-step of length h in which nothing happens, or a little more; 1 if that is all of it.
double PointFlow::share_until_event(double h) {
  if (!has_events_) return 1.0;
  const double least = is_sliding() ? std::min(1.0, dwell() / h) : 0.0;
  if (least > 0.0 && is_event(least)) return least;
  double before = least;
  for (int look = 1; look <= kLooks; ++look) {
    double after = least + (1.0 - least) * look / kLooks;
    if (!is_event(after)) {
      before = after;
      continue;
    }
    while (after - before > kEventShare) {
      const double middle = (before + after) / 2;
      (is_event(middle) ? after : before) = middle;
    }
    return after;
  }
  return 1.0;
}

/// Tries a sub-step of length h, and sets the length to try next. @returns false if there is no next state
bool PointFlow::advance(double& left, double& h) {
  if (is_stiff_) return advance_stiffly(left, h);
  const double smallest = period_ * (++steps_ < kMostEvaluations ? kSmallestStep : kSlidingStep);
  if (steps_ > kMostEvaluations && is_sliding()) return false;
  h = std::min(h, left);
  pair_.step([this](const Values& x, Values& result) { derivative(x, result); }, x_, h);
  const double error = relative_error();
  if (error > 1.0 && h > smallest) {
    h = std::max(h * growth(error, 1.0), smallest);
    return true;
  }
  if (!std::isfinite(error)) return false;
  const double share = share_until_event(h);
  if (share == 1.0 && pair_.stiffness() > kStable) ++stiff_steps_;
  if (share * h < kDwell * period_) ++short_events_;
  left -= share * h;
  if (share < 1.0) {
    pair_.interpolate(share, x_);
  } else {
    x_ = pair_.end();
  }
  if (has_events_) settle();
  h = std::max(h * growth(error, 5.0), smallest);
  return true;
}

void PointFlow::interpolate(double share, Values& x) const {
  if (is_stiff_) {
    stiff_->interpolate(share, x);
  } else {
    pair_.interpolate(share, x);
  }
}

void PointFlow::begin_stiffly() {
  if (!stiff_) {
    const auto field = [this](const Values& x, Values& result) { derivative(x, result); };
    stiff_.emplace(field, scale_, tolerance_);
  }
  is_stiff_ = true;
  stiff_->begin(x_);
}

/// advance() by the solver for stiff systems, which begins anew after an event.
bool PointFlow::advance_stiffly(double& left, double& h) {
  if (++steps_ > kMostEvaluations) return false;
  h = stiff_->step(left);
  if (h <= 0.0) return false;
  const double share = share_until_event(h);
  if (share * h < kDwell * period_) ++short_events_;
  left -= share * h;
  interpolate(share, x_);
  if (!x_.allFinite()) return false;
  if (!has_events_) return true;
  settle();
  if (share < 1.0) stiff_->begin(x_);
  return true;
}

std::optional<std::vector<double>> PointFlow::after_period(std::span<const double> slots) {
  slots_.assign(slots.begin(), slots.end());
  for (std::size_t i = 0; i < slots_of_states_.size(); ++i) {
    x_(static_cast<Eigen::Index>(i)) = slots[slots_of_states_[i]];
  }
  std::fill(turned_.begin(), turned_.end(), 0.0);
  steps_ = stiff_steps_ = short_events_ = 0;
  is_stiff_ = false;
  settle();
  double left = period_;
  for (double h = period_; left > 0.0;) {
    const bool found = advance(left, h);
    ++tried_;
    followed_ = 1.0 - left / period_;
    if ((!found && is_stiff_) || steps_ > most_) return std::nullopt;
    if (!is_stiff_ && (!found || stiff_steps_ > kStiffSteps)) begin_stiffly();
  }
  std::vector<double> end(turned_);
  for (std::size_t i = 0; i < end.size(); ++i) end[i] += x_(static_cast<Eigen::Index>(i));
  return end;
}

}  // namespace coordreq

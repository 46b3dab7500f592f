#include "reach/face_flow.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using outward::add_up;
using outward::kInfinity;
using outward::multiply_up;

/// Ticks of a period: steps have a whole number of them.
constexpr std::uint64_t kFaceTicks = std::uint64_t{1} << 40U;
constexpr std::uint64_t kLongestFace = kFaceTicks / 16;
/// Steps are not made shorter than this for the sake of a tighter result.
constexpr std::uint64_t kFine = kFaceTicks / 256;
constexpr int kFaceMostTries = 3000;
constexpr int kFacePatience = 3;
/// The change that derivatives of unknown size may add in a period, as a fraction of the width of the
/// initial box.
constexpr double kFaceTolerance = 0.1;
/// A state that decays by more than this within a step is bounded by where it settles.
constexpr double kFaceStrongDecay = 1.0;

constexpr int kLevelRounds = 14;
constexpr int kModestRounds = 4;
constexpr int kLevelTries = 8;
constexpr int kBisections = 20;
constexpr int kRateRounds = 7;
/// A rate that is not proven in so many rounds is replaced by values over all of the step.
constexpr int kRatePatience = 4;

double margin(double x) {
  return 1e-14 * std::fabs(x) + 1e-290;
}

void set_end(Interval& a, bool upper, double value) {
  (upper ? a.upper : a.lower) = upper ? value : -value;
}

/// The largest value of start + h slope for h in `duration`.
double moved_by(double start, const Interval& duration, double slope) {
  return (Interval(start) + duration * Interval(slope)).upper;
}

}  // namespace

FaceFlow::FaceFlow(const FlowSystem& system)
    : n_(system.equations.size()),
      state_slots_(system.state_slots),
      tolerance_(n_),
      now_(n_),
      next_(n_),
      box_(n_),
      face_(n_),
      level_(2 * n_),
      simple_(2 * n_),
      bounds_(2 * n_) {
  for (std::size_t i = 0; i < n_; ++i) slopes_.emplace_back(system, i);
  moving_.lower.resize(n_);
  moving_.upper.resize(n_);
  moving_.box.resize(n_);
}

std::optional<FlowFailure> FaceFlow::enclose(std::span<const Interval> slots, const VectorField& field,
                                             const Interval& period, FlowEnclosure& result) {
  begin(slots, field, period);
  result.tube = now_;
  result.drift.assign(n_, Interval{});
  std::uint64_t left = kFaceTicks;
  // For a state that starts from a point there is no scale of precision.
  const bool any_point =
      std::any_of(now_.begin(), now_.end(), [](const Interval& a) { return a.is_point(); });
  const std::uint64_t longest = any_point ? kLongestFace / 8 : kLongestFace;
  std::uint64_t ticks = longest;
  int successes = 0;
  for (int tries = 0; left > 0; ++tries) {
    ticks = std::min(ticks, left);
    if (settles_) ticks = std::min(ticks, std::max(left / 2, kFine / 16));
    const double share = static_cast<double>(ticks) / static_cast<double>(kFaceTicks);
    ++tries_;
    if (tries == kFaceMostTries) return FlowFailure{false, worst_};
    if (try_step(period * Interval(share), ticks > kFine)) {
      left -= ticks;
      finish_step(period * Interval(share), result);
      if (++successes % kFacePatience == 0) ticks = std::min(2 * ticks, longest);
    } else if (ticks > 1) {
      ticks /= 2;
      successes = 0;
    } else {
      return FlowFailure{undefined_, worst_};
    }
  }
  result.end = now_;
  result.status = FlowEnclosure::Status::ok;
  return std::nullopt;
}

void FaceFlow::begin(std::span<const Interval> slots, const VectorField& field, const Interval& period) {
  field_ = &field;
  period_ = period.upper;
  fastest_decay_ = 0.0;
  settles_ = false;
  for (std::size_t i = 0; i < n_; ++i) {
    now_[i] = field.clipped(i, slots[state_slots_[i]]);
    tolerance_[i] = kFaceTolerance * (now_[i].upper - now_[i].lower);
    slopes_[i].begin(slots);
  }
}

/// @param divisible whether a shorter step is worth trying for a tighter result
bool FaceFlow::try_step(const Interval& duration, bool divisible) {
  undefined_ = false;
  if (!find_levels(duration.upper)) return false;
  for (std::size_t i = 0; i < n_; ++i) {
    if (slopes_[i].on_box(box_).total) continue;
    undefined_ = true;
    worst_ = i;
    return false;
  }
  if (!find_rates(duration)) return false;
  for (std::size_t i = 0; i < n_ && divisible; ++i) {
    const double allowed = tolerance_[i] * duration.upper / period_;
    if (tolerance_[i] == 0.0) continue;
    for (const bool upper : {false, true}) {
      const FaceSlope::Bound& bound = bounds_[side(i, upper)];
      if (bound.found && 0.5 * duration.upper * bound.spread > allowed) return false;
    }
  }
  return true;
}

/// The levels that no state passes during the step. Each either cannot be reached in time, with the fastest
/// speed on the way to it, or no solution moves on from it; the others being in `box_`, with a margin.
bool FaceFlow::find_levels(double duration) {
  for (std::size_t i = 0; i < n_; ++i) {
    for (const bool upper : {false, true})
      set_level(i, upper, add_up(start(i, upper), margin(start(i, upper))));
  }
  for (int round = 0; round < kLevelRounds; ++round) {
    bool all_hold = true;
    for (std::size_t i = 0; i < n_; ++i) {
      for (const bool upper : {false, true}) {
        if (holds(i, upper, level_[side(i, upper)], duration)) continue;
        all_hold = false;
        worst_ = i;
        if (!raise_level(i, upper, duration, round)) return false;
      }
    }
    if (all_hold) return true;
  }
  return false;
}

void FaceFlow::set_level(std::size_t i, bool upper, double level) {
  level_[side(i, upper)] = level;
  set_end(box_[i], upper, level + margin(level));
}

bool FaceFlow::holds(std::size_t i, bool upper, double level, double duration) {
  if (level >= limit(i, upper)) return true;
  const double slope = steepest(i, upper, start(i, upper), level);
  if (slope <= 0.0 || add_up(start(i, upper), multiply_up(duration, slope)) < level) return true;
  return steepest(i, upper, level, level + 2.0 * margin(level)) <= 0.0;
}

/// The largest outward speed of a state that is at `from` to `to`, seen outward.
double FaceFlow::steepest(std::size_t i, bool upper, double from, double to) {
  const Interval whole = box_[i];
  box_[i] = upper ? Interval{from, to} : Interval{-to, -from};
  const Interval value = slopes_[i].on_box(box_);
  box_[i] = whole;
  const double result = outward_end(value, upper);
  return value.total && result <= outward::kLargest ? result : kInfinity;
}

bool FaceFlow::raise_level(std::size_t i, bool upper, double duration, int round) {
  const double from = start(i, upper);
  double low = level_[side(i, upper)];
  const double slope = steepest(i, upper, from, low);
  if (slope > outward::kLargest) return false;
  const double inflation = 1.125 * (round > kModestRounds ? std::ldexp(1.0, round - kModestRounds) : 1.0);
  double distance = std::max(inflation * std::max(duration * slope, 0.0), 2.0 * (low - from));
  double high = from + distance;
  for (int n = 0; !holds(i, upper, high, duration); ++n) {
    if (n == kLevelTries) return false;
    low = high;
    distance *= 4.0;
    high = from + distance;
  }
  // A state that settles need not be followed as far as it could get without settling.
  if (high < limit(i, upper) && duration * steepest(i, upper, from, high) >= high - from) {
    for (int n = 0; n < kBisections; ++n) {
      const double middle = 0.5 * low + 0.5 * high;
      (holds(i, upper, middle, duration) ? high : low) = middle;
    }
    high += (0.01 * (round + 1)) * (high - from);
  }
  set_level(i, upper, std::min(high, limit(i, upper)));
  return true;
}

/// The limit at which `stop` holds the state, seen outward.
double FaceFlow::limit(std::size_t i, bool upper) const {
  return outward_end(field_->clipped(i, whole_line(true)), upper);
}

/// The limit on the other side, which may lie between two doubles, seen in the same direction.
double FaceFlow::innermost_level(std::size_t i, bool upper) const {
  const double level = -limit(i, !upper);
  return level < -outward::kLargest ? level : level + margin(level);
}

/// How fast each end moves: assumed, found on the faces that move so, and assumed to be somewhat more until
/// that proves itself.
bool FaceFlow::find_rates(const Interval& duration) {
  moving_.duration = duration.upper;
  moving_.box = box_;
  for (std::size_t i = 0; i < n_; ++i) {
    moving_.lower[i] = {now_[i].lower, first_rate(i, false)};
    moving_.upper[i] = {now_[i].upper, first_rate(i, true)};
  }
  std::fill(simple_.begin(), simple_.end(), false);
  for (int round = 0; round < kRateRounds; ++round) {
    bool proven = true;
    for (std::size_t i = 0; i < n_; ++i) {
      for (const bool upper : {false, true}) proven = update_rate(i, upper, duration, round) && proven;
    }
    if (proven) return true;
  }
  return false;
}

/// By what the equation is at the start.
Interval FaceFlow::first_rate(std::size_t i, bool upper) {
  face_ = now_;
  face_[i] = Interval(upper ? now_[i].upper : now_[i].lower);
  const Interval value = slopes_[i].on_box(face_);
  return Interval(std::clamp(upper ? value.upper : value.lower, -1e100, 1e100));
}

/// @returns whether the end moves as was assumed
bool FaceFlow::update_rate(std::size_t i, bool upper, const Interval& duration, int round) {
  const std::size_t s = side(i, upper);
  if (simple_[s]) return true;
  FaceSlope::Bound& bound = bounds_[s];
  bound = slopes_[i].on_face(moving_, upper, tolerance_[i] / period_);
  fastest_decay_ = std::max(fastest_decay_, -bound.decay);
  MovingEnd& end = upper ? moving_.upper[i] : moving_.lower[i];
  const auto assumes = [&](const Interval& outward_rate) {
    const Interval rate = upper ? outward_rate : -outward_rate;
    return end.rate.lower <= rate.lower && rate.upper <= end.rate.upper;
  };
  Interval rate{bound.least, std::max(bound.start, bound.end)};
  // Where the state may be stopped on the way inward, its end does not go on from beyond the limit.
  const double innermost = moved_by(start(i, upper), duration, std::min(rate.lower, 0.0));
  const bool stopped = rate.lower < 0.0 && innermost <= innermost_level(i, upper);
  const bool followed = bound.found && bound.decay * duration.upper >= -kFaceStrongDecay && !stopped;
  if (followed && assumes(rate)) {
    set_end(next_[i], upper, end_of_step(start(i, upper), duration, bound));
    return true;
  }
  if (!followed || round >= kRatePatience) {
    simple_[s] = true;
    settles_ = true;
    bound.found = false;
    rate = settle(i, upper, duration);
  }
  const double more = simple_[s] ? 0.0 : 0.125 * (rate.upper - rate.lower) + margin(rate.upper);
  const Interval enough{rate.lower - more, rate.upper + more};
  end.rate = hull(end.rate, upper ? enough : -enough);
  return false;
}

/// A speed that is convex in time is at most the mean of its ends, on the average.
double FaceFlow::end_of_step(double start, const Interval& duration, const FaceSlope::Bound& bound) {
  const double mean = 0.5 * add_up(bound.start, bound.end);
  const double slack = multiply_up(std::fabs(bound.end - bound.start), duration.upper - duration.lower);
  return add_up(moved_by(start, duration, mean), slack);
}

/// An end that moves as fast as it can anywhere between where it is and its level; inward no further than to
/// where it would move more slowly. Puts it into `next_`. @returns its rates, seen outward
Interval FaceFlow::settle(std::size_t i, bool upper, const Interval& duration) {
  const double from = start(i, upper);
  const double level = std::max(from, level_[side(i, upper)]);
  double slope = steepest(i, upper, from, level);
  if (slope >= 0.0) {
    set_end(next_[i], upper, std::min(level, moved_by(from, duration, slope)));
    return {0.0, slope};
  }
  double high = from;
  double low = std::max(-outward_end(now_[i], !upper), innermost_level(i, upper));
  double best = from;
  for (int n = 0; n < kBisections && low < high; ++n) {
    const double middle = 0.5 * low + 0.5 * high;
    const double speed = steepest(i, upper, middle, level);
    const double reached = moved_by(from, duration, speed);
    if (std::max(middle, reached) < best) {
      best = std::max(middle, reached);
      slope = speed;
    }
    (reached > middle ? low : high) = middle;
  }
  set_end(next_[i], upper, best);
  return {slope, 0.0};
}

void FaceFlow::finish_step(const Interval& duration, FlowEnclosure& result) {
  for (std::size_t i = 0; i < n_; ++i) {
    Interval tube = hull(now_[i], next_[i]);
    for (const bool upper : {false, true}) {
      const Interval& rate = upper ? moving_.upper[i].rate : moving_.lower[i].rate;
      if (simple_[side(i, upper)] || rate.lower >= 0.0 || rate.upper <= 0.0) continue;
      const double farthest = moved_by(start(i, upper), duration, outward_end(rate, upper));
      set_end(tube, upper, std::max(outward_end(tube, upper), farthest));
    }
    result.tube[i] = hull(result.tube[i], field_->clipped(i, tube));
    result.drift[i] = result.drift[i] + duration * hull(slopes_[i].on_box(box_), Interval{});
  }
  for (std::size_t i = 0; i < n_; ++i) now_[i] = field_->clipped(i, next_[i]);
}

}  // namespace coordreq

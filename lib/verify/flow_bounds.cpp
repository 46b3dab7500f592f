#include "verify/flow_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "verify/transition_bounds.hpp"

namespace coordreq {
namespace {

constexpr int kMostSteps = 128;  // for the sensitivity
constexpr int kPicardTries = 30;
constexpr std::uint32_t kFinest = 1U << 14U;  // parts of the period
constexpr double kTolerance = 1e-14;
constexpr std::size_t kMostKnown = 1 << 16;

const Interval kZero{0.0, 0.0};

Interval point_of(double value) {
  return {value, value};
}

double middle_of(const Interval& a) {
  return std::clamp(a.lower + (a.upper - a.lower) / 2, a.lower, a.upper);
}

bool is_finite(const Interval& a) {
  return std::isfinite(a.lower) && std::isfinite(a.upper);
}

bool keeps_its_sign(const Interval& a) {
  return a.lower >= 0.0 || a.upper <= 0.0;
}

double magnitude(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper));
}

Interval widened(const Interval& a) {
  const double margin = 0.1 * (a.upper - a.lower) + 1e-12 * magnitude(a) + 1e-300;
  return {a.lower - margin, a.upper + margin, a.total};
}

bool is_inside(const Interval& a, const Interval& b) {
  return b.lower <= a.lower && a.upper <= b.upper;
}

}  // namespace

FlowBounds::FlowBounds(const ProblemSpec& spec, const Influences& influences, std::size_t state,
                       const Rational& duration)
    : spec_(&spec),
      n_(influences.moving.size()),
      m_(influences.disturbances.size()),
      period_(enclose(duration)),
      series_(
          [&] {
            std::vector<const Program*> equations;
            for (const std::size_t j : influences.moving) equations.push_back(&spec.dynamics.equations[j]);
            return equations;
          }(),
          [&] {
            std::vector<std::uint32_t> slots;
            for (const std::size_t j : influences.moving) slots.push_back(spec.state_slot(j));
            return slots;
          }()),
      jacobian_(n_ * n_),
      input_slope_(n_ * m_) {
  for (const std::size_t j : influences.moving) {
    if (j == state) position_ = state_slots_.size();
    state_slots_.push_back(spec.state_slot(j));
    sloped_.emplace_back(spec.dynamics.equations[j]);
  }
  for (const std::size_t l : influences.disturbances) disturbance_slots_.push_back(spec.disturbance_slot(l));
}

std::optional<Interval> FlowBounds::after_period(const std::vector<Interval>& slots, int halvings) {
  const std::optional<Ends> found = ends(slots, halvings);
  if (!found) return std::nullopt;
  return Interval{found->least.lower, found->greatest.upper};
}

std::optional<FlowBounds::Ends> FlowBounds::ends(const std::vector<Interval>& slots, int halvings) {
  if (known_.size() > kMostKnown) known_.clear();
  Box box = slots;
  return bounds(box, halvings);
}

std::optional<FlowBounds::Motion> FlowBounds::motion(const std::vector<Interval>& slots, int parts) {
  const Interval duration = period_ / point_of(parts);
  Motion result;
  Box now = slots;
  Box tube = slots;
  Box all = slots;
  std::vector<Interval> change(n_);
  for (int part = 0; part < parts; ++part) {
    if (!enclose_solutions(now, duration, tube)) return std::nullopt;
    // The image of the tube is a tube as well, and a narrower one.
    series_.derivative(tube, change);
    for (std::size_t i = 0; i < n_; ++i) {
      const std::uint32_t slot = state_slots_[i];
      tube[slot] = now[slot] + Interval{0.0, duration.upper} * change[i];
      all[slot] = hull(all[slot], tube[slot]);
    }
    series_.derivative(tube, change);
    if (!change[position_].total || !is_finite(change[position_])) return std::nullopt;
    result.slope.push_back(change[position_]);
    for (std::size_t i = 0; i < n_; ++i) now[state_slots_[i]] = now[state_slots_[i]] + duration * change[i];
  }
  const std::uint32_t own = state_slots_[position_];
  result.stays_below_start = is_wall(all, {slots[own].upper, all[own].upper}, true);
  result.stays_above_start = is_wall(all, {all[own].lower, slots[own].lower}, false);
  return result;
}

/// Whether the state cannot get to where its derivative does not point: had it done so, it would have moved
/// against its derivative since it was last inside.
/// @param tube of all states; @param outside where the state would be
bool FlowBounds::is_wall(Box tube, const Interval& outside, bool upper) {
  tube[state_slots_[position_]] = outside;
  std::vector<Interval> change(n_);
  series_.derivative(tube, change);
  const Interval& own = change[position_];
  return own.total && (upper ? own.upper <= 0.0 : own.lower >= 0.0);
}

std::optional<FlowBounds::Ends> FlowBounds::bounds(Box& box, int halvings_left) {
  int steps = 2;
  while (!find_sensitivity(box, steps)) {
    steps *= 4;
    if (steps > kMostSteps) return std::nullopt;
  }
  std::optional<std::size_t> without_sign;
  double weight = 0.0;
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval& range = box[state_slots_[j]];
    if (range.is_point() || keeps_its_sign(sensitivity_[j])) continue;
    const double own_weight = magnitude(sensitivity_[j]) * (range.upper - range.lower);
    if (!without_sign || own_weight > weight) {
      without_sign = j;
      weight = own_weight;
    }
  }
  if (!without_sign || halvings_left == 0) {
    const std::optional<Interval> low = end_from(box, false);
    const std::optional<Interval> high = end_from(box, true);
    if (!low || !high) return std::nullopt;
    return Ends{*low, *high};
  }
  const std::uint32_t slot = state_slots_[*without_sign];
  const Interval whole = box[slot];
  const double middle = middle_of(whole);
  box[slot] = {whole.lower, middle};
  const std::optional<Ends> first = bounds(box, halvings_left - 1);
  box[slot] = {middle, whole.upper};
  const std::optional<Ends> second = first ? bounds(box, halvings_left - 1) : std::nullopt;
  box[slot] = whole;
  if (!second) return std::nullopt;
  const auto lesser = [](const Interval& a, const Interval& b) {
    return Interval{std::min(a.lower, b.lower), std::min(a.upper, b.upper)};
  };
  const auto greater = [](const Interval& a, const Interval& b) {
    return Interval{std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
  };
  return Ends{lesser(first->least, second->least), greater(first->greatest, second->greatest)};
}

/// The row of M, and hulls of the kernels of the disturbances.
bool FlowBounds::find_sensitivity(const Box& box, int step_count) {
  const Interval duration = period_ / point_of(step_count);
  std::vector<Matrix> steps;
  std::vector<Matrix>
      local;  // all the transitions from within a step to its end, times the disturbance's slope
  Box now = box;
  Box tube = box;
  std::vector<Interval> change(n_);
  for (int step = 0; step < step_count; ++step) {
    if (!enclose_solutions(now, duration, tube) || !find_jacobian(tube)) return false;
    steps.push_back(transition_bounds(n_, jacobian_, duration));
    const Matrix within = transition_bounds(n_, jacobian_, {0.0, duration.upper});
    Matrix& kernel = local.emplace_back(n_ * m_, kZero);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t l = 0; l < m_; ++l) {
        for (std::size_t j = 0; j < n_; ++j)
          kernel[i * m_ + l] = kernel[i * m_ + l] + within[i * n_ + j] * input_slope_[j * m_ + l];
      }
    }
    series_.derivative(tube, change);
    for (std::size_t i = 0; i < n_; ++i) now[state_slots_[i]] = now[state_slots_[i]] + duration * change[i];
  }
  std::vector<Interval> row(n_, kZero);
  row[position_] = {1.0, 1.0};
  kernel_.assign(m_, kZero);
  for (std::size_t step = steps.size(); step-- > 0;) {
    std::vector<Interval> before(n_, kZero);
    for (std::size_t l = 0; l < m_; ++l) {
      Interval sum = kZero;
      for (std::size_t j = 0; j < n_; ++j) sum = sum + row[j] * local[step][j * m_ + l];
      kernel_[l] = step + 1 == steps.size() ? sum : hull(kernel_[l], sum);
    }
    for (std::size_t j = 0; j < n_; ++j) {
      for (std::size_t k = 0; k < n_; ++k) before[j] = before[j] + row[k] * steps[step][k * n_ + j];
    }
    row = before;
  }
  sensitivity_ = row;
  const auto fine = [](const Interval& a) { return is_finite(a); };
  return std::all_of(sensitivity_.begin(), sensitivity_.end(), fine) &&
         std::all_of(kernel_.begin(), kernel_.end(), fine);
}

bool FlowBounds::find_jacobian(const Box& tube) {
  std::vector<Sloped<Interval>> slots(tube.size());
  for (std::size_t s = 0; s < tube.size(); ++s) slots[s].value = tube[s];
  for (std::size_t j = 0; j < n_ + m_; ++j) {
    Sloped<Interval>& variable = slots[j < n_ ? state_slots_[j] : disturbance_slots_[j - n_]];
    variable.gradient.assign(n_ + m_, kZero);
    variable.gradient[j] = {1.0, 1.0};
  }
  for (std::size_t i = 0; i < n_; ++i) {
    const Sloped<Interval>& f = sloped_[i].number(slots);
    if (!f.smooth || !f.total || !f.value.total) return false;
    for (std::size_t j = 0; j < n_ + m_; ++j) {
      const Interval slope = f.gradient.empty() ? kZero : f.gradient[j];
      if (!slope.total || !is_finite(slope)) return false;
      (j < n_ ? jacobian_[i * n_ + j] : input_slope_[i * m_ + (j - n_)]) = slope;
    }
  }
  return true;
}

/// A box that holds now + [0, h] f(box) holds all solutions over h.
bool FlowBounds::enclose_solutions(const Box& start, const Interval& duration, Box& tube) {
  tube = start;
  std::vector<Interval> change(n_);
  for (int attempt = 0; attempt < kPicardTries; ++attempt) {
    series_.derivative(tube, change);
    bool inside = true;
    for (std::size_t i = 0; i < n_; ++i) {
      const std::uint32_t slot = state_slots_[i];
      if (!change[i].total || !is_finite(change[i])) return false;
      const Interval next = start[slot] + Interval{0.0, duration.upper} * change[i];
      inside = inside && is_inside(next, tube[slot]);
    }
    if (inside) return true;
    for (std::size_t i = 0; i < n_; ++i) {
      const std::uint32_t slot = state_slots_[i];
      const Interval next = start[slot] + Interval{0.0, duration.upper} * change[i];
      tube[slot] = hull(tube[slot], widened(hull(start[slot], next)));
    }
  }
  return false;
}

/// The solution that has the least (greatest) end, or what bounds it.
std::optional<Interval> FlowBounds::end_from(const Box& box, bool upper) {
  Box start = box;
  Interval rest = kZero;
  const auto choose = [&](std::uint32_t slot, const Interval& slope, const Interval& times) {
    Interval& place = start[slot];
    const Interval range = place;
    if (range.is_point()) return;
    if (keeps_its_sign(slope)) {
      const bool rising = slope.lower >= 0.0;
      place = point_of(rising == upper ? range.upper : range.lower);
      return;
    }
    place = point_of(middle_of(range));
    rest = rest + times * slope * (range - place);
  };
  for (std::size_t j = 0; j < n_; ++j) choose(state_slots_[j], sensitivity_[j], {1.0, 1.0});
  for (std::size_t l = 0; l < m_; ++l) choose(disturbance_slots_[l], kernel_[l], {0.0, period_.upper});
  const std::optional<Interval> end = solution_from(start);
  if (!end) return std::nullopt;
  return *end + rest;
}

std::optional<Interval> FlowBounds::solution_from(const Box& point) {
  Place place;
  for (const Interval& value : point) place.push_back(value.lower);
  const auto found = known_.find(place);
  if (found != known_.end()) return found->second;
  Box now = point;
  std::uint32_t left = kFinest;
  std::uint32_t parts = kFinest;
  bool ok = true;
  while (ok && left > 0) {
    parts = std::min(parts, left);
    const double share = static_cast<double>(parts) / kFinest;
    if (advance(now, period_ * point_of(share), parts == 1)) {
      left -= parts;
    } else if (parts > 1) {
      parts /= 2;
    } else {
      ok = false;
    }
  }
  std::optional<Interval> end;
  if (ok) end = now[state_slots_[position_]];
  known_.emplace(std::move(place), end);
  return end;
}

/// A Taylor step with Lagrange's remainder; on the finest level one of first order, which needs no
/// smoothness.
bool FlowBounds::advance(Box& now, const Interval& duration, bool last_try) {
  Box tube;
  if (!enclose_solutions(now, duration, tube)) return false;
  constexpr std::size_t kOrder = TimeSeries::kOrder;
  std::vector<Interval> next(n_);
  if (series_.expand(tube)) {
    Interval power{1.0, 1.0};
    for (std::size_t k = 0; k < kOrder; ++k) power = power * duration;
    bool precise = true;
    for (std::size_t i = 0; i < n_; ++i) {
      next[i] = series_.coefficient(i, kOrder) * power;
      precise =
          precise && next[i].upper - next[i].lower <= kTolerance * (1.0 + magnitude(tube[state_slots_[i]]));
    }
    if (!precise && !last_try) return false;
    if (!series_.expand(now)) return false;
    for (std::size_t i = 0; i < n_; ++i) {
      Interval sum = series_.coefficient(i, kOrder - 1);
      for (std::size_t k = kOrder - 1; k-- > 0;) sum = sum * duration + series_.coefficient(i, k);
      next[i] = next[i] + sum;
    }
  } else {
    if (!last_try) return false;
    series_.derivative(tube, next);
    for (std::size_t i = 0; i < n_; ++i) next[i] = now[state_slots_[i]] + duration * next[i];
  }
  for (std::size_t i = 0; i < n_; ++i) now[state_slots_[i]] = next[i];
  return true;
}

}  // namespace coordreq

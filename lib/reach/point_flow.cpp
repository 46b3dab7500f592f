#include "reach/point_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coordreq {
namespace {

constexpr double kTolerance = 1e-12;
constexpr double kEventStep = 0x1p-40;  // of the period
constexpr double kSmallestStep = 0x1p-36;
constexpr double kSlidingStep = 0x1p-10;
constexpr int kPatience = 5000;

constexpr std::size_t kStages = 7;
// Table 2 of Dormand and Prince; the last row of kWeights is also the solution of order 5.
constexpr double kWeights[kStages][kStages - 1] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
// Order 5 less order 4.
constexpr double kError[kStages] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                    -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

}  // namespace

PointFlow::PointFlow(const ProblemSpec& spec, std::span<const std::int32_t> moving)
    : period_(nearest_double(spec.dynamics.period)),
      held_(moving.size()),
      stages_(kStages, Values(moving.size())),
      stage_point_(moving.size()) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const std::int32_t j : moving) {
    const auto i = static_cast<std::size_t>(j);
    const StateSpec& state = spec.states[i];
    const Rational last =
        state.grid.first + state.grid.step * Rational(static_cast<long>(state.grid.count - 1));
    slots_of_states_.push_back(spec.state_slot(i));
    equations_.emplace_back(spec.dynamics.equations[i]);
    limits_.push_back({state.below == Outside::stop ? nearest_double(state.grid.first) : -kNone,
                       state.above == Outside::stop ? nearest_double(last) : kNone});
    scale_.push_back(nearest_double(state.grid.step));
  }
}

/// f_i without regard to limits.
double PointFlow::raw_derivative(std::size_t i, const Values& x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    slots_[slots_of_states_[j]] = std::clamp(x[j], limits_[j].lower, limits_[j].upper);
  }
  return equations_[i].number(slots_);
}

void PointFlow::derivative(const Values& x, Values& result) {
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = held_[i] != 0 ? 0.0 : raw_derivative(i, x);
}

/// Which states are at a limit with f pointing out of it.
void PointFlow::find_held(const Values& x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    held_[i] = 0;
    if (x[i] == limits_[i].upper && raw_derivative(i, x) > 0) held_[i] = 1;
    if (x[i] == limits_[i].lower && raw_derivative(i, x) < 0) held_[i] = -1;
  }
}

/// One step of length h. @returns its estimated error in units of what is tolerated
double PointFlow::step(const Values& x, double h, Values& next) {
  for (std::size_t s = 0; s < kStages; ++s) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      double sum = 0;
      for (std::size_t r = 0; r < s; ++r) sum += kWeights[s][r] * stages_[r][i];
      stage_point_[i] = x[i] + h * sum;
    }
    derivative(stage_point_, stages_[s]);
  }
  next = stage_point_;
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double error = 0;
    for (std::size_t s = 0; s < kStages; ++s) error += kError[s] * stages_[s][i];
    const double ratio = std::fabs(h * error) / (kTolerance * std::max(std::fabs(x[i]), scale_[i]));
    if (!std::isfinite(next[i]) || !std::isfinite(ratio)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, ratio);
  }
  return worst;
}

/// Whether a limit was passed in the step to `next`, or a state should have left its limit by then.
bool PointFlow::misses_event(const Values& next) {
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (next[i] > limits_[i].upper || next[i] < limits_[i].lower) return true;
    if (held_[i] != 0 && raw_derivative(i, next) * held_[i] < 0) return true;
  }
  return false;
}

std::optional<std::vector<double>> PointFlow::after_period(std::span<const double> slots) {
  slots_.assign(slots.begin(), slots.end());
  Values x;
  for (const std::uint32_t slot : slots_of_states_) x.push_back(slots[slot]);
  Values next;
  double time = 0;
  double h = period_;
  for (int steps = 0; time < period_; ++steps) {
    const double smallest = period_ * (steps < kPatience ? kSmallestStep : kSlidingStep);
    const double event = period_ * (steps < kPatience ? kEventStep : kSlidingStep);
    const bool last = h >= period_ - time;
    if (last) h = period_ - time;
    find_held(x);
    const double error = step(x, h, next);
    if (error > 1 && h > smallest) {
      const double shrink = std::isfinite(error) ? std::max(0.2, 0.9 * std::pow(error, -0.2)) : 0.2;
      h = std::max(h * shrink, smallest);
      continue;
    }
    if (!std::isfinite(error)) return std::nullopt;
    if (misses_event(next) && h > event) {
      h /= 2;
      continue;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = std::clamp(next[i], limits_[i].lower, limits_[i].upper);
    }
    if (last) return x;
    time += h;
    const double grow = error > 0 ? std::clamp(0.9 * std::pow(error, -0.2), 0.2, 5.0) : 5.0;
    h = std::max(h * grow, smallest);
  }
  return x;
}

}  // namespace coordreq

#include <algorithm>

#include "reach/flow_solver.hpp"

namespace coordreq {
namespace {

using End = FollowedSolution::End;

/// Where to start for the extreme of something that depends on a variable with this sensitivity.
/// @param tolerated a part of the sensitivity that may have the other sign
End extreme_end(const Interval& range, const Interval& sensitivity, double tolerated, bool upper) {
  if (range.is_point() || sensitivity.is_zero()) return End::any;
  const End if_rising = upper ? End::upper : End::lower;
  const End if_falling = upper ? End::lower : End::upper;
  if (sensitivity.lower >= 0.0) return if_rising;
  if (sensitivity.upper <= 0.0) return if_falling;
  const bool rising = sensitivity.upper >= -sensitivity.lower;
  if (std::min(-sensitivity.lower, sensitivity.upper) > tolerated) return End::middle;
  return rising ? if_rising : if_falling;
}

/// The range relative to the start of the solution.
Interval around(const Interval& range, End end) {
  const double value = end == End::lower ? range.lower : end == End::upper ? range.upper : midpoint(range);
  return range - Interval(value);
}

bool keeps_sign(const Interval& a) {
  return a.lower >= 0.0 || a.upper <= 0.0;
}

bool agree(const std::vector<End>& a, const std::vector<End>& b) {
  for (std::size_t j = 0; j < a.size(); ++j) {
    if (a[j] != b[j] && a[j] != End::any && b[j] != End::any) return false;
  }
  return true;
}

double value_at(const Interval& range, End end) {
  switch (end) {
    case End::lower:
      return range.lower;
    case End::upper:
      return range.upper;
    default:
      return midpoint(range);
  }
}

/// At a limit the state is the limit itself, which need not be a double.
struct StartValue {
  Interval value;
  bool at_limit = false;
};
StartValue start_value(const FlowSystem::Limit& limit, double value) {
  if (limit.above && value >= limit.upper.lower) return {limit.upper, true};
  if (limit.below && value <= limit.lower.upper) return {limit.lower, true};
  return {Interval(value), false};
}

}  // namespace

void ValidatedFlow::Solver::set_start(FollowedSolution& solution) const {
  solution.steps_done = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    const FlowSystem::Limit limit = system_.stops.empty() ? FlowSystem::Limit{} : system_.stops[j];
    const StartValue start = start_value(limit, value_at(initial_[j], solution.ends[j]));
    solution.state.value[j] = start.value;
    solution.state.at_limit[j] = start.at_limit;
  }
}

void ValidatedFlow::Solver::set_disturbances(const std::vector<End>& ends) {
  for (std::size_t l = 0; l < m_; ++l) {
    field_.set_disturbance(l, Interval(value_at(disturbance_[l], ends[n_ + l])));
  }
}

void ValidatedFlow::Solver::restore_disturbances() {
  for (std::size_t l = 0; l < m_; ++l) field_.set_disturbance(l, disturbance_[l]);
}

bool ValidatedFlow::Solver::advance(const FlowStep& step, NominalFlow::State& state) {
  if (!step.smooth) return nominal_.advance(step.duration, step.choices, tolerance_, state);
  advance_smoothly(step, state.value);
  std::fill(state.at_limit.begin(), state.at_limit.end(), false);
  return true;
}

/// A Taylor step from the middle of the enclosure so far, which grows as differences of solutions do:
/// evaluating the polynomial over all of it would let rounding errors grow where solutions converge.
void ValidatedFlow::Solver::advance_smoothly(const FlowStep& step, std::vector<Interval>& state) {
  keep_within(step, state);
  alone_.split(state);
  state = alone_.middle;
  taylor_.advance(field_, step.duration, step.choices, none_held_, step.remainder, state);
  alone_.carry_on(step.transition, state);
}

/// A solution is among all of them, and so is the middle of where it can be then: where bounds for all of
/// them hold.
void ValidatedFlow::Solver::keep_within(const FlowStep& step, std::vector<Interval>& state) const {
  for (std::size_t i = 0; takes_long_steps_ && i < n_; ++i)
    state[i] = intersect(state[i], step.start[i]).value_or(state[i]);
}

void Deviation::split(std::span<const Interval> state) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    by[i] = UpwardInterval(state[i]);
    middle[i] = Interval(midpoint(state[i]));
  }
  rounded_upward([this] {
    wide = false;
    for (std::size_t i = 0; i < by.size(); ++i) {
      by[i] += UpwardInterval(-middle[i].lower);
      wide = wide || !by[i].is_zero();
    }
  });
}

void Deviation::carry_on(const UpwardMatrix& transition, std::vector<Interval>& state) const {
  if (!wide) return;
  rounded_upward([&] {
    for (std::size_t i = 0; i < by.size(); ++i) {
      UpwardInterval sum;
      for (std::size_t j = 0; j < by.size(); ++j)
        sum += transition(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * by[j];
      state[i] = (UpwardInterval(state[i]) + sum).interval(state[i].total);
    }
  });
}

/// Those that extremes came from in the last step: mostly they are asked for again.
void ValidatedFlow::Solver::take_solutions_along() {
  for (std::size_t s = 0; s < solution_count_ && along_count_ < along_.size(); ++s) {
    FollowedSolution& solution = solutions_[s];
    const bool is_used = std::find(solution_of_.begin(), solution_of_.end(), s) != solution_of_.end();
    if (!is_used || solution.steps_done != step_count_) continue;
    Along& along = along_[along_count_++];
    along.solution = s;
    keep_within(steps_[step_count_], solution.state.value);
    along.start.split(solution.state.value);
    std::copy(field_.slots().begin(), field_.slots().end(), slots_.begin());
    for (std::size_t i = 0; i < n_; ++i) slots_[system_.state_slots[i]] = along.start.middle[i];
    for (std::size_t l = 0; l < m_; ++l)
      slots_[system_.disturbance_slots[l]] = Interval(value_at(disturbance_[l], solution.ends[n_ + l]));
    taylor_.take_along(slots_);
  }
}

/// The last step of a solution that was taken along.
void ValidatedFlow::Solver::advance_along(std::size_t along, FollowedSolution& solution) {
  const FlowStep& step = steps_[step_count_ - 1];
  taylor_.advance_along(along, step.remainder, solution.state.value);
  along_[along].start.carry_on(step.transition, solution.state.value);
  std::fill(solution.state.at_limit.begin(), solution.state.at_limit.end(), false);
  ++solution.steps_done;
}

/// Brings a solution up to the present step. @returns whether it could be enclosed
bool ValidatedFlow::Solver::follow(std::size_t s) {
  FollowedSolution& solution = solutions_[s];
  if (solution.steps_done + 1 == step_count_ && steps_[solution.steps_done].smooth) {
    for (std::size_t a = 0; a < along_count_; ++a) {
      if (along_[a].solution != s) continue;
      advance_along(a, solution);
      return true;
    }
  }
  set_disturbances(solution.ends);
  bool found = true;
  while (solution.steps_done < step_count_ && found) {
    found = advance(steps_[solution.steps_done], solution.state);
    if (found) ++solution.steps_done;
  }
  restore_disturbances();
  return found;
}

/// The distance that an extreme can lie beyond the solution that is followed for it: by the mean value
/// theorem for the variables without a proven sign, and the discontinuities.
double ValidatedFlow::Solver::deviation(std::size_t i, bool upper, const std::vector<End>& ends) const {
  Interval sum{-sensitivity_.jump(i), sensitivity_.jump(i)};
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval& sensitivity = sensitivity_.initial(i, j);
    if (ends[j] == End::any || keeps_sign(sensitivity)) continue;
    sum = sum + sensitivity * around(initial_[j], ends[j]);
  }
  for (std::size_t l = 0; l < m_; ++l) {
    const Interval& kernel = sensitivity_.kernel(i, l);
    const End end = ends[n_ + l];
    if (end == End::any || keeps_sign(kernel)) continue;
    const Interval weight =
        end == End::middle ? Interval(sensitivity_.weight(i, l)) * Interval{-1.0, 1.0} : period_ * kernel;
    sum = sum + weight * around(disturbance_[l], end);
  }
  return upper ? sum.upper : sum.lower;
}

/// The ends from which the lower and the upper extreme of state i are followed.
void ValidatedFlow::Solver::choose_ends(std::size_t i, bool upper, std::vector<End>& ends) const {
  // An end that is nearly right costs less than the middle: at most the width times what has the other sign,
  // against half the width times the largest sensitivity.
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval& sensitivity = sensitivity_.initial(i, j);
    const double tolerated = 0.5 * std::max(-sensitivity.lower, sensitivity.upper);
    ends[j] = extreme_end(initial_[j], sensitivity, tolerated, upper);
  }
  for (std::size_t l = 0; l < m_; ++l) {
    const double tolerated = tape_.affine ? 0.0 : 0.5 * sensitivity_.weight(i, l) / period_.upper;
    ends[n_ + l] = extreme_end(disturbance_[l], sensitivity_.kernel(i, l), tolerated, upper);
  }
}

/// A solution whose start agrees with `ends`; an earlier one if possible.
std::size_t ValidatedFlow::Solver::solution_for(const std::vector<End>& ends) {
  for (std::size_t s = 0; s < solution_count_; ++s) {
    FollowedSolution& known = solutions_[s];
    if (!agree(known.ends, ends)) continue;
    for (std::size_t j = 0; j < ends.size(); ++j) {
      if (known.ends[j] == End::any) known.ends[j] = ends[j];
    }
    return s;
  }
  if (solution_count_ == solutions_.size()) {
    solutions_.push_back({ends, {std::vector<Interval>(n_), std::vector<bool>(n_)}, 0});
  }
  solutions_[solution_count_].ends = ends;
  return solution_count_++;
}

/// Where a disturbance of an affine system acts with both signs, its weight up to rounding. Limits would put
/// an end to what cancels.
void ValidatedFlow::Solver::integrate_affine_kernels() {
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t l = 0; l < m_; ++l) {
      if (extreme_end(disturbance_[l], sensitivity_.kernel(i, l), 0.0, true) != End::middle) continue;
      const double weight = affine_kernel_.integral(jacobian_, period_, i, l);
      sensitivity_.set_weight(i, l, std::min(weight, sensitivity_.weight(i, l)));
    }
  }
}

void ValidatedFlow::Solver::follow_extremes(bool last) {
  if (last && tape_.affine && !ever_stopped_) integrate_affine_kernels();
  const std::size_t old_count = solution_count_;
  for (std::size_t e = 0; e < 2 * n_; ++e) {
    choose_ends(e / 2, e % 2 == 1, wanted_[e]);
    solution_of_[e] = solution_for(wanted_[e]);
  }
  for (std::size_t s = old_count; s < solution_count_; ++s) {
    std::vector<End>& ends = solutions_[s].ends;
    std::replace(ends.begin(), ends.end(), End::any, End::middle);
    set_start(solutions_[s]);
  }
  for (std::size_t s = 0; s < solution_count_; ++s) {
    if (std::find(solution_of_.begin(), solution_of_.end(), s) == solution_of_.end()) continue;
    if (!follow(s)) continue;
    if (last) note_attained(solutions_[s]);
    for (std::size_t e = 0; e < 2 * n_; ++e) {
      if (solution_of_[e] == s) use_extreme(e / 2, e % 2 == 1, solutions_[s], wanted_[e]);
    }
  }
}

/// In long steps a solution may be known far less well than where it is: its middle then stands for it.
void ValidatedFlow::Solver::note_attained(const FollowedSolution& solution) {
  const std::vector<Interval>& value = solution.state.value;
  const bool is_first = attained_.empty();
  attained_.resize(n_);
  for (std::size_t i = 0; i < n_; ++i) {
    const Interval at = takes_long_steps_ ? Interval(midpoint(value[i])) : value[i];
    attained_[i] = is_first ? at : hull(attained_[i], at);
  }
}

/// Moves one end of `next_` to what the solution that was followed says.
void ValidatedFlow::Solver::use_extreme(std::size_t i, bool upper, const FollowedSolution& solution,
                                        const std::vector<End>& ends) {
  const Interval found = field_.clipped(i, solution.state.value[i] + Interval(deviation(i, upper, ends)));
  if (upper && found.upper >= next_[i].lower) next_[i].upper = std::min(next_[i].upper, found.upper);
  if (!upper && found.lower <= next_[i].upper) next_[i].lower = std::max(next_[i].lower, found.lower);
}

}  // namespace coordreq

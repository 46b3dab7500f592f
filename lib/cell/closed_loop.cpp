#include "cell/closed_loop.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/requires.hpp"
#include "model/sample_reset.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Kind = Location::Kind;

std::vector<double> nearest_doubles(const std::vector<Rational>& values) {
  std::vector<double> result;
  for (const Rational& value : values) result.push_back(nearest_double(value));
  return result;
}

Rational draw_between(const Rational& lower, const Rational& upper, Disturbance kind, RandomStream& random) {
  if (lower == upper) return lower;
  if (kind == Disturbance::extremes) return random.below(2) == 0 ? lower : upper;
  return lower + (upper - lower) * random.fraction();
}

}  // namespace

std::int64_t RunTrace::coordinated_steps() const {
  return std::count_if(steps.begin(), steps.end(), [](const Step& step) { return step.coordinated; });
}

std::int64_t RunTrace::longest_silence() const {
  std::int64_t longest = 0;
  std::int64_t current = 0;
  for (const Step& step : steps) {
    current = step.coordinated ? 0 : current + 1;
    longest = std::max(longest, current);
  }
  return longest;
}

std::int64_t RunTrace::outside_goal() const {
  return std::ranges::count_if(samples, [](const Sample& sample) { return !sample.in_goal; });
}

std::optional<std::int64_t> RunTrace::last_outside_goal() const {
  for (std::int64_t k = std::ssize(samples); k-- > 0;) {
    if (!samples[static_cast<std::size_t>(k)].in_goal) return k;
  }
  return std::nullopt;
}

std::optional<std::int64_t> RunTrace::longest_gap() const {
  std::optional<std::int64_t> visit, longest;
  for (std::int64_t k = 0; k < std::ssize(samples); ++k) {
    if (!samples[static_cast<std::size_t>(k)].in_goal) continue;
    if (visit) longest = std::max(longest.value_or(0), k - *visit);
    visit = k;
  }
  return longest;
}

double RunTrace::smallest_margin() const {
  double smallest = std::numeric_limits<double>::infinity();
  const std::size_t count = samples.size() - (outcome == Outcome::left_safely ? 1 : 0);
  for (std::size_t k = 0; k < count; ++k) smallest = std::min(smallest, samples[k].margin);
  return smallest;
}

ClosedLoop::ClosedLoop(const LoopProblem& problem, const LoopOptions& options)
    : problem_(problem),
      options_(options),
      dynamics_(*problem.spec),
      chooser_(problem, options.policy, dynamics_, controller_),
      next_(*problem.spec, *problem.abstraction, dynamics_),
      margin_(problem.spec->safe),
      slots_(problem.spec->slot_count()),
      delay_(problem.delay()),
      ends_in_goal_(options.until_goal || problem.spec->ends_at_goal()) {
  if (problem.spec->is_goal_lasting()) goal_.emplace(*problem.spec->goal);
  if (problem.spec->ends_at_goal()) to_aim_ = problem_.values.at(paths::kArrival);
  for (const AnswerPolicy& policy : problem_.policies) {
    if (!policy.aim.path.empty()) to_aim_ = problem_.values.at(policy.aim.path);
  }
  mode_choosers_ = choosers_of_modes();
}

bool ClosedLoop::is_in_k(const std::vector<Rational>& measured) const {
  const Location location = locate(problem_.abstraction->grid, measured);
  if (location.kind != Kind::cell) return false;
  const std::span<const std::int32_t> delay =
      options_.silent_steps ? problem_.values.at(problem_.policies[1].delay) : delay_;
  return delay[static_cast<std::size_t>(location.cell)] >= 0;
}

RunTrace ClosedLoop::run(std::vector<Rational> measured, std::uint64_t run) {
  REQUIRES(is_in_k(measured));
  if (problem_.network != nullptr) return run_lossy(std::move(measured), run);
  if (options_.silent_steps) return run_silent(std::move(measured), run);
  RandomStream actions(options_.seed, run, RandomStream::Purpose::actions);
  RandomStream disturbances(options_.seed, run, RandomStream::Purpose::disturbances);
  State state = first_state(std::move(measured), draw_nature(disturbances));
  RunTrace trace;
  add_sample(state, trace);
  std::size_t policy = policy_at(state, trace);
  std::int32_t countdown = begin_countdown(policy, state, trace);
  trace.samples.back().countdown = countdown;
  const bool is_lasting = problem_.spec->is_goal_lasting();
  const std::int32_t promised = has_aim(policy) && !is_lasting ? trace.samples.front().arrival : kUnbounded;
  for (std::int64_t k = 0; k < options_.steps; ++k) {
    if (is_at_end(trace)) {
      trace.outcome = Outcome::reached_goal;
      return trace;
    }
    const bool coordinated = countdown == 0;
    const Nature nature = draw_nature(disturbances);
    next_.begin(state.exact, nature.disturbance, nature.error, state.place.cell);
    // Agents that coordinate follow the policy that holds here, whichever countdown ended here.
    if (coordinated) policy = policy_at(state, trace);
    if (is_through(policy, trace)) policy = 0;
    const bool is_aimed = is_lasting && has_aim(policy);
    const std::optional<std::int64_t> u = chooser_.choose(
        state.place.cell, state.measured, {.policy = policy, .countdown = countdown}, next_, actions);
    if (!u) {
      trace.outcome = Outcome::no_action;
      return trace;
    }
    if (chooser_.forbids(state.place.cell, *u)) {
      trace.outcome = Outcome::not_allowed;
      return trace;
    }
    if (!next_.is_known(*u) && !next_.has_left(*u)) {
      trace.outcome = Outcome::not_followed;
      trace.followed = next_.followed(*u);
      return trace;
    }
    trace.steps.push_back({*u, coordinated, nearest_doubles(nature.disturbance)});
    const std::optional<std::int32_t> agreed =
        coordinated ? chooser_.countdown_after(policy, state.place.cell, *u) : std::nullopt;
    const bool known = advance(state, *u, nature);
    RunTrace::Sample& reached = add_sample(state, trace);
    if (countdown != kUnbounded) {
      if (coordinated) policy = policy_at(state, trace);
      countdown = !coordinated ? countdown - 1
                  : agreed     ? reset_countdown(*agreed)
                               : begin_countdown(policy, state, trace);
    }
    reached.countdown = countdown;
    if (state.place.kind == Kind::left_safely) {
      trace.outcome = is_at_end(trace) ? Outcome::reached_goal : Outcome::left_safely;
      return trace;
    }
    if (!known || reached.delay < 0) {
      trace.outcome = Outcome::left_invariant;
      return trace;
    }
    if ((!trace.arrived && k + 1 >= promised) || (is_aimed && !is_step_of_aim(trace))) {
      trace.outcome = Outcome::late;
      return trace;
    }
  }
  if (is_at_end(trace)) trace.outcome = Outcome::reached_goal;
  return trace;
}

std::size_t ClosedLoop::policy_at(const State& state, const RunTrace& trace) {
  if (state.place.kind != Kind::cell) return 0;
  std::size_t policy = problem_.policies.size() - 1;
  while (policy > 0 && (is_through(policy, trace) || !chooser_.holds(policy, state.place.cell))) --policy;
  return policy;
}

std::int32_t ClosedLoop::begin_countdown(std::size_t policy, const State& state,
                                         const RunTrace& trace) const {
  if (policy == 0) return reset_countdown(trace.samples.back().delay);
  if (problem_.policies[policy].is_on_request) return 0;  // nobody has agreed on anything yet
  const std::span<const std::int32_t> delay = problem_.values.at(problem_.policies[policy].delay);
  return reset_countdown(delay[static_cast<std::size_t>(state.place.cell)]);
}

/// Whether the last step was one of P, as far as arrival says.
bool ClosedLoop::is_step_of_aim(const RunTrace& trace) const {
  const std::int32_t before = trace.samples[trace.samples.size() - 2].arrival;
  const std::int32_t after = trace.samples.back().arrival;
  if (problem_.spec->goal_then == GoalThen::stay) return after <= before;
  return before == 0 ? after != kUnbounded && after >= 0 : after < before;
}

/// @pre it has left through `goal` or `safe` sides alone
bool ClosedLoop::is_beyond_goal_side(const State& state) const {
  REQUIRES(state.place.kind == Kind::left_safely);
  const UniformGrid& grid = problem_.abstraction->grid;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Rational upper = grid[i].point(grid[i].count - 1) + grid[i].radius();
    const bool below = state.measured[i] < grid[i].point(0) - grid[i].radius();
    const bool above = grid[i].discrete ? state.measured[i] > upper : state.measured[i] >= upper;
    if (!below && !above) continue;
    if (traits(below ? grid[i].below : grid[i].above).is_only_safe()) return false;
  }
  return true;
}

std::int32_t ClosedLoop::reset_countdown(std::int32_t delay) const {
  if (delay < 0) return 0;
  return delay >= problem_.connection_delay || delay == kUnbounded ? delay : 0;
}

Nature ClosedLoop::draw_nature(RandomStream& random) const {
  Nature nature;
  const bool constant = options_.disturbance == Disturbance::constant;
  for (const DisturbanceSpec& w : problem_.spec->disturbances) {
    const std::size_t l = nature.disturbance.size();
    nature.disturbance.push_back(constant ? options_.constant_disturbance[l]
                                          : draw_between(w.lower, w.upper, options_.disturbance, random));
  }
  for (const GridDimension& dimension : problem_.abstraction->grid.dimensions()) {
    const Rational& most = dimension.measurement_error;
    nature.error.push_back(constant ? Rational(0) : draw_between(-most, most, options_.disturbance, random));
  }
  return nature;
}

/// The true state is the measured one less the error; never beyond a `stop` limit, where no state is.
ClosedLoop::State ClosedLoop::first_state(std::vector<Rational> measured, const Nature& nature) const {
  State state;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const GridDimension& dimension = problem_.abstraction->grid[i];
    Rational value = measured[i] - nature.error[i];
    if (dimension.periodic()) value = reset_at_sample(dimension, value);
    if (traits(dimension.below).stops) value = std::max(value, dimension.first);
    if (traits(dimension.above).stops) value = std::min(value, dimension.point(dimension.count - 1));
    state.exact.push_back(value);
  }
  const Location location = locate(problem_.abstraction->grid, measured);
  state.place = {.kind = location.kind, .cell = location.cell};
  state.measured = std::move(measured);
  return state;
}

bool ClosedLoop::advance(State& state, std::int64_t u, const Nature& nature) {
  state.place = next_.place(u);
  bool all_known = true;
  for (std::size_t i = 0; i < state.exact.size(); ++i) {
    const NextStates::Value& value = next_.state(i, u);
    all_known = all_known && value.known;
    if (!value.known) continue;  // the trace keeps the last value that was known
    state.exact[i] = value.value;
    const GridDimension& dimension = problem_.abstraction->grid[i];
    state.measured[i] = value.value + nature.error[i];
    if (dimension.periodic()) state.measured[i] = reset_at_sample(dimension, state.measured[i]);
  }
  return all_known;
}

RunTrace::Sample& ClosedLoop::add_sample(const State& state, RunTrace& trace) {
  RunTrace::Sample& own = trace.samples.emplace_back(sample(state));
  const bool is_there = !to_aim_.empty() && own.arrival == 0;
  if (is_there && !trace.arrived) trace.arrived = std::ssize(trace.samples) - 1;
  return own;
}

RunTrace::Sample ClosedLoop::sample(const State& state) {
  RunTrace::Sample result{.state = nearest_doubles(state.exact), .measured = nearest_doubles(state.measured)};
  for (std::size_t i = 0; i < state.exact.size(); ++i) slots_[problem_.spec->state_slot(i)] = state.exact[i];
  result.margin = margin_.value(slots_);
  if (goal_ && state.place.kind != Kind::left_safely) result.in_goal = goal_->value(slots_) >= 0;
  if (state.place.kind == Kind::cell) {
    result.delay = delay_[static_cast<std::size_t>(state.place.cell)];
  } else {
    result.delay = state.place.kind == Kind::left_safely ? kUnbounded : kOutsideSafe;
  }
  if (goal_ && state.place.kind == Kind::left_safely) result.in_goal = is_beyond_goal_side(state);
  if (to_aim_.empty()) return result;
  if (state.place.kind == Kind::cell) {
    result.arrival = to_aim_[static_cast<std::size_t>(state.place.cell)];
    result.in_goal = result.in_goal || (goal_ && result.arrival == 0);
  } else {
    const bool is_there = state.place.kind == Kind::left_safely && is_beyond_goal_side(state);
    result.arrival = is_there ? 0 : kUnbounded;
  }
  return result;
}

}  // namespace coordreq

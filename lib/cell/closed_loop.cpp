#include "cell/closed_loop.hpp"

#include <algorithm>
#include <utility>

#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
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

bool is_beyond_stop(const GridDimension& dimension, const Rational& value) {
  return (traits(dimension.below).stops && value < dimension.first) ||
         (traits(dimension.above).stops && value > dimension.point(dimension.count - 1));
}

/// The cells of K where all that memories keep is as at first, drawn from without a list of them: counts by
/// block, then a walk through one block.
class InvariantCells {
 public:
  /// @param steps of all cells, negative outside K
  InvariantCells(const SystemSpec& spec, std::span<const std::int32_t> steps) : steps_(steps) {
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      if (spec.dynamics.is_kept(i)) stride_ *= at(spec.states[i].grid.count);
    }
    for (std::size_t begin = 0; begin < steps.size(); begin += kBlock) {
      before_.push_back(count_);
      const std::size_t end = std::min(begin + kBlock, steps.size());
      for (std::size_t x = begin; x < end; ++x) count_ += has(x) ? 1U : 0U;
    }
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }

  [[nodiscard]] std::int64_t draw(RandomStream& random) const {
    REQUIRES(count_ > 0);  // of a start that is given ClosedLoop::run() needs as much
    const std::uint64_t wanted = random.below(count_);
    const auto block = std::upper_bound(before_.begin(), before_.end(), wanted) - before_.begin() - 1;
    std::uint64_t passed = before_[at(block)];
    std::size_t x = at(block) * kBlock;
    while (!has(x) || passed++ < wanted) ++x;
    return static_cast<std::int64_t>(x);
  }

 private:
  static constexpr std::size_t kBlock = 4096;

  [[nodiscard]] bool has(std::size_t cell) const { return steps_[cell] >= 0 && cell % stride_ == 0; }

  std::span<const std::int32_t> steps_;
  std::size_t stride_ = 1;             ///< of the states that no memory keeps
  std::vector<std::uint64_t> before_;  ///< cells before each block
  std::uint64_t count_ = 0;
};

std::vector<Rational> draw_start(const UniformGrid& grid, const InvariantCells& cells, RandomStream& random) {
  for (;;) {
    const std::int64_t x = cells.draw(random);
    std::vector<Rational> state;
    bool possible = true;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const GridDimension& dimension = grid[i];
      Rational value = dimension.point(grid.index(x, i));
      if (!dimension.discrete) value += dimension.step * (random.fraction() - Rational(1) / 2);
      if (dimension.periodic()) value = reset_at_sample(dimension, value);
      possible = possible && !is_beyond_stop(dimension, value);
      state.push_back(value);
    }
    if (possible) return state;
  }
}

}  // namespace

ClosedLoop::ClosedLoop(const LoopProblem& problem, const LoopOptions& options)
    : problem_(problem),
      options_(options),
      dynamics_(*problem.spec),
      schedule_(make_schedule(problem, options.policy, options.silent_steps.value_or(kUnbounded), dynamics_,
                              controller_)),
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
}

bool ClosedLoop::is_in_k(const std::vector<Rational>& measured) const {
  const Location location = locate(problem_.abstraction->grid, measured);
  if (location.kind != Kind::cell) return false;
  return problem_.start_steps()[static_cast<std::size_t>(location.cell)] >= 0;
}

RunTrace ClosedLoop::run(std::vector<Rational> measured, std::uint64_t run) {
  REQUIRES(is_in_k(measured));
  RandomStream actions(options_.seed, run, RandomStream::Purpose::actions);
  RandomStream disturbances(options_.seed, run, RandomStream::Purpose::disturbances);
  State state = first_state(std::move(measured), draw_nature(disturbances));
  RunTrace trace;
  const auto end = [&trace](Outcome outcome) {
    trace.outcome = outcome;
    return std::move(trace);
  };
  add_sample(state, trace);
  trace.samples.back().countdown =
      schedule_->begin(trace, {options_.seed, run, RandomStream::Purpose::losses});
  while (std::ssize(trace.steps) < options_.steps && !is_at_end(trace)) {
    const std::int64_t cell = state.location.cell;
    const Nature nature = draw_nature(disturbances);
    next_.begin(state.exact, nature.disturbance, nature.error, cell);
    const auto& [chooser, turn] = schedule_->turn(trace);
    const std::optional<std::int64_t> u = chooser.choose(cell, state.measured, turn, next_, actions);
    if (!u || chooser.forbids(cell, *u)) return end(schedule_->stopped(trace, u.has_value()));
    if (!next_.is_known(*u) && !next_.has_left(*u)) {
      trace.followed = next_.followed(*u);
      return end(Outcome::not_followed);
    }
    trace.steps.push_back({*u, turn.countdown == 0, nearest_doubles(nature.disturbance)});
    advance(state, *u, nature);
    add_sample(state, trace);
    trace.samples.back().countdown = schedule_->arrive(trace);
    if (state.location.kind == Kind::left_safely)
      return end(is_at_end(trace) ? Outcome::reached_goal : Outcome::left_safely);
    if (const std::optional<Outcome> fault = schedule_->fault(trace)) return end(*fault);
  }
  return end(is_at_end(trace) ? Outcome::reached_goal : Outcome::completed);
}

/// @pre it has left through `goal` or `safe` sides alone
bool ClosedLoop::is_beyond_goal_side(const State& state) const {
  REQUIRES(state.location.kind == Kind::left_safely);
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
  state.location = {.kind = location.kind, .cell = location.cell};
  state.measured = std::move(measured);
  return state;
}

void ClosedLoop::advance(State& state, std::int64_t u, const Nature& nature) {
  state.location = next_.location(u);
  for (std::size_t i = 0; i < state.exact.size(); ++i) {
    const NextStates::Value& value = next_.state(i, u);
    if (!value.known) continue;  // the trace keeps the last value that was known
    state.exact[i] = value.value;
    const GridDimension& dimension = problem_.abstraction->grid[i];
    state.measured[i] = value.value + nature.error[i];
    if (dimension.periodic()) state.measured[i] = reset_at_sample(dimension, state.measured[i]);
  }
}

void ClosedLoop::add_sample(const State& state, RunTrace& trace) {
  RunTrace::Sample& sample =
      trace.samples.emplace_back(RunTrace::Sample{.state = nearest_doubles(state.exact),
                                                  .measured = nearest_doubles(state.measured),
                                                  .cell = state.location.cell});
  for (std::size_t i = 0; i < state.exact.size(); ++i) slots_[problem_.spec->state_slot(i)] = state.exact[i];
  sample.margin = margin_.value(slots_);
  const bool is_cell = state.location.kind == Kind::cell, has_left = state.location.kind == Kind::left_safely;
  const bool is_beyond_goal = has_left && is_beyond_goal_side(state);
  sample.delay = is_cell ? delay_[at(sample.cell)] : has_left ? kUnbounded : kOutsideSafe;
  if (!to_aim_.empty()) sample.arrival = is_cell ? to_aim_[at(sample.cell)] : is_beyond_goal ? 0 : kUnbounded;
  const bool is_there = !to_aim_.empty() && sample.arrival == 0;
  if (goal_) sample.in_goal = has_left ? is_beyond_goal : (is_cell && is_there) || goal_->value(slots_) >= 0;
  if (is_there && !trace.arrived) trace.arrived = std::ssize(trace.samples) - 1;
}

std::vector<RunTrace> simulate_runs(const LoopProblem& problem, const LoopOptions& options,
                                    ThreadTeam& team) {
  std::optional<InvariantCells> cells;
  if (!options.start) cells.emplace(*problem.spec, problem.start_steps());
  std::vector<std::unique_ptr<ClosedLoop>> loops(at(team.size()));
  std::vector<RunTrace> traces(at(options.runs));
  team.for_each(options.runs, 1, [&](ThreadTeam::Range range, int worker) {
    std::unique_ptr<ClosedLoop>& loop = loops[at(worker)];
    if (!loop) loop = std::make_unique<ClosedLoop>(problem, options);
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      const auto number = static_cast<std::uint64_t>(r);
      RandomStream random(options.seed, number, RandomStream::Purpose::start);
      traces[at(r)] = loop->run(
          options.start ? *options.start : draw_start(problem.abstraction->grid, *cells, random), number);
    }
  });
  return traces;
}

bool has_start(const SystemSpec& spec, std::span<const std::int32_t> steps) {
  return InvariantCells(spec, steps).count() > 0;
}

}  // namespace coordreq

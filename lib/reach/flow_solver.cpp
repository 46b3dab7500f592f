#include "reach/flow_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/fast_paths.hpp"

namespace coordreq {
namespace {

/// Ticks of a period: steps have a whole number of them. If one tick has no enclosure, nothing helps.
constexpr std::uint32_t kTicks = 1U << 20U;
constexpr std::size_t kMostTries = 20000;
/// After some tries, steps that would be so many times as many as are allowed in all are not worth more.
constexpr std::size_t kHopeTries = 24;
constexpr std::size_t kHope = 3;
/// Decay by more powers of e than this within a period is called stiff.
constexpr double kStiff = 1000.0;
/// Longer steps are tried again after so many that went well.
constexpr int kPatience = 3;
/// Steps this small are taken although the sensitivity stays unbounded.
constexpr std::uint32_t kSmallWithoutBound = kTicks / 32;
constexpr std::uint32_t kSmallWithoutRemainder = kTicks / 4096;
/// Seams are passed in steps as small.
constexpr std::uint32_t kSmallOnSeam = kTicks / 64;
/// The remainder that a step may add, relative to the width of the initial box and to the magnitude.
constexpr double kWidthTolerance = 1e-7;
constexpr double kMagnitudeTolerance = 1e-15;
constexpr double kLeastTolerance = 1e-290;
/// A step by faces costs as much as so many sub-steps along a solution: 7 to 20 where it was measured.
constexpr std::int64_t kFaceWork = 16;
/// A state that decays faster than this within the step counts as damped without bound.
constexpr double kStrongDecay = 8.0;

bool is_always_smooth(const FlowSystem& system, const FlowTape& tape) {
  return system.seams.empty() &&
         std::none_of(system.stops.begin(), system.stops.end(),
                      [](const FlowSystem::Limit& limit) { return limit.below || limit.above; }) &&
         std::none_of(tape.values.begin(), tape.values.end(),
                      [&tape](std::uint32_t i) { return tape.nodes[i].is_choice(); });
}

}  // namespace

ValidatedFlow::Solver::Solver(FlowSystem system, const Interval& period)
    : system_(std::move(system)),
      period_(period),
      n_(system_.equations.size()),
      m_(system_.disturbance_slots.size()),
      tape_(system_.equations, system_.state_slots, system_.disturbance_slots),
      field_(system_, tape_),
      jacobian_(system_, tape_),
      transition_(n_, tape_.affine ? TransitionMatrix::kManyTerms : TransitionMatrix::kFewTerms),
      sensitivity_(n_, m_),
      taylor_(tape_),
      nominal_(tape_, field_),
      affine_kernel_(n_),
      faces_(system_),
      wanted_(2 * n_, std::vector<End>(n_ + m_)),
      solution_of_(2 * n_),
      initial_(n_),
      disturbance_(m_),
      now_(n_),
      box_(n_),
      derivative_(n_),
      next_(n_),
      slots_(system_.slot_count),
      damped_(n_),
      none_held_(n_),
      tolerance_(n_),
      allowed_excess_(n_),
      always_smooth_(is_always_smooth(system_, tape_)) {
  if (fast_paths().tangents && always_smooth_ && m_ == 0 && !tape_.affine && system_.summed) {
    std::vector<std::uint32_t> slots(n_);
    std::iota(slots.begin(), slots.end(), static_cast<std::uint32_t>(system_.slot_count));
    auto tape = FlowTape::with_tangents(system_.equations, system_.state_slots, slots);
    if (tape) tangent_.emplace(std::move(*tape), system_);
  }
  alone_ = Deviation(n_);
  for (Along& along : along_) along.start = alone_;
  result_.end.resize(n_);
  result_.tube.resize(n_);
  result_.drift.resize(n_);
}

void ValidatedFlow::Solver::begin(std::span<const Interval> slots) {
  field_.begin(slots);
  jacobian_.begin(slots);
  sensitivity_.reset();
  step_count_ = 0;
  for (std::size_t i = 0; i < n_; ++i) initial_[i] = field_.clipped(i, slots[system_.state_slots[i]]);
  for (std::size_t l = 0; l < m_; ++l) disturbance_[l] = slots[system_.disturbance_slots[l]];
  takes_long_steps_ = may_take_long_steps_ && is_line(initial_);
  result_.in_long_steps = takes_long_steps_;
  if (takes_long_steps_) tangent_->begin(slots);
  now_ = initial_;
  solution_count_ = 0;
  ever_stopped_ = false;
  restarted_ = false;
  attained_.clear();
  gave_up_ = false;
  fastest_decay_ = fastest_growth_ = 0.0;
  result_.status = FlowEnclosure::Status::ok;
  result_.tube = initial_;
  std::fill(result_.drift.begin(), result_.drift.end(), Interval{});
}

/// @param patient goes on although steps are so short that there are not enough of them
/// @returns whether that led to the end of the period
bool ValidatedFlow::Solver::run_steps(std::size_t most_steps, bool patient) {
  std::uint32_t left = kTicks;
  // Subboxes of one box take like steps; the box itself comes first, so that nothing earlier counts.
  std::uint32_t ticks = takes_long_steps_ ? std::min(kTicks, 2 * first_ticks_) : kTicks;
  first_ticks_ = ticks;
  int successes = 0;
  bool known_to_fail = false;
  tries_ = 0;
  while (left > 0) {
    ticks = std::min(ticks, left);
    ++tries_;
    ++all_tries_;
    const double share = static_cast<double>(ticks) / kTicks;
    const bool divisible = ticks > kSmallWithoutRemainder;
    const auto failure = known_to_fail && divisible ? std::optional<FlowFailure>(FlowFailure{})
                                                    : try_step(period_ * Interval{share, share}, divisible);
    known_to_fail = false;
    if (!failure) {
      if (left == kTicks) first_ticks_ = ticks;
      left -= ticks;
      if (++successes % kPatience == 0) {
        known_to_fail = left > ticks && twice_is_too_long();
        ticks *= 2;
      }
      const bool hopeless = !patient && tries_ > kHopeTries && left / ticks > kHope * most_steps;
      gave_up_ = left > 0 && (tries_ >= most_steps || hopeless);
      if (!hopeless) finish_step(left == 0);
      gave_up_ = gave_up_ || (left > 0 && (is_too_wide() || (patient && is_anywhere())));
      if (gave_up_) {
        fail(FlowFailure{false, fastest()});
        return false;
      }
    } else if (ticks > 1 && tries_ < kMostTries) {
      ticks /= 2;
      successes = 0;
    } else {
      fail(*failure);
      return false;
    }
  }
  result_.end = now_;
  return true;
}

/// Whether a step twice as long as the last one is sure to have no usable remainder. Others may be taken
/// without one, where they meet a kink or a limit.
bool ValidatedFlow::Solver::twice_is_too_long() {
  const FlowStep& step = steps_[step_count_ - 1];
  return always_smooth_ && step.smooth && !taylor_.could_be_doubled(step.duration, tolerance_);
}

std::int64_t ValidatedFlow::Solver::extra_steps() const {
  return kFaceWork * faces_.tries() + nominal_.tries();
}

/// The state that changes most in the last step.
std::size_t ValidatedFlow::Solver::fastest() const {
  const auto slower = [](const Interval& a, const Interval& b) { return a.magnitude() < b.magnitude(); };
  const auto found = std::max_element(derivative_.begin(), derivative_.end(), slower);
  return static_cast<std::size_t>(found - derivative_.begin());
}

/// Notes the rate of each state, from the Jacobian.
void ValidatedFlow::Solver::note_rates() {
  for (std::size_t i = 0; i < n_; ++i) {
    if (-jacobian_.state()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)).lower >
        fastest_decay_) {
      fastest_decay_ = -jacobian_.state()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)).lower;
      stiffest_ = i;
    }
    fastest_growth_ = std::max(
        fastest_growth_, jacobian_.state()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)).upper);
  }
}

void ValidatedFlow::Solver::fail(const FlowFailure& failure) {
  jacobian_.evaluate(now_);
  note_rates();
  result_.status = failure.undefined ? FlowEnclosure::Status::undefined : FlowEnclosure::Status::blows_up;
  result_.culprit = failure.equation;
  const bool stiff = fastest_decay_ > fastest_growth_ && fastest_decay_ * period_.upper > kStiff;
  if (!failure.undefined && stiff) {
    result_.status = FlowEnclosure::Status::too_stiff;
    result_.culprit = stiffest_;
  }
  result_.rate = fastest_decay_;
  if (failure.undefined) result_.undefined_at.assign(field_.slots().begin(), field_.slots().end());
  result_.end = now_;
}

FlowStep& ValidatedFlow::Solver::next_step() {
  if (step_count_ == steps_.size()) {
    steps_.emplace_back();
    steps_.back().choices.resize(tape_.nodes.size());
  }
  return steps_[step_count_];
}

/// @returns why the step is too long; nothing if it is done
std::optional<FlowFailure> ValidatedFlow::Solver::try_step(const Interval& duration, bool divisible) {
  along_count_ = 0;
  if (const auto failure = field_.enclose_solutions(now_, duration, box_, derivative_)) return failure;
  if (field_.is_on_seam(box_)) return try_step_on_seam(duration);
  FlowStep& step = next_step();
  step.duration = duration;
  if (takes_long_steps_) step.start = now_;
  find_damping(duration);
  step.smooth = decide(tape_, field_.values(), step.choices) && all_free_;
  set_tolerance();
  if (step.smooth) {
    taylor_.begin(field_, step.choices, none_held_);
    take_solutions_along();
    taylor_.find_remainder(duration, tolerance_, step.remainder);
    step.smooth = step.remainder.order > 0;
    // A singularity is better dealt with along single solutions, which are farther away from it.
    if (!step.smooth && divisible && step.remainder.bounded) return FlowFailure{};
  }
  if (!append_sensitivity(duration, divisible)) return FlowFailure{};
  ++step_count_;
  return std::nullopt;
}

/// Where a right-hand side jumps by a whole period, all that is kept is the box and f over it.
std::optional<FlowFailure> ValidatedFlow::Solver::try_step_on_seam(const Interval& duration) {
  if (duration.upper * kTicks > period_.upper * kSmallOnSeam) return FlowFailure{};
  next_step().duration = duration;
  find_damping(duration);
  sensitivity_.lose();
  ++step_count_;
  return std::nullopt;
}

/// In long steps a state that starts from a point need not be followed more precisely than the other one.
void ValidatedFlow::Solver::set_tolerance() {
  double width = 0.0;
  for (std::size_t i = 0; takes_long_steps_ && i < system_.steps.size(); ++i)
    width = std::max(width, initial_[i].width() / system_.steps[i]);
  for (std::size_t i = 0; i < n_; ++i) {
    const double own = initial_[i].width();
    tolerance_[i] = std::max(kWidthTolerance * (width > 0.0 ? std::max(own, width * system_.steps[i]) : own),
                             kMagnitudeTolerance * box_[i].magnitude() + kLeastTolerance);
    if (tape_.affine) tolerance_[i] = kMagnitudeTolerance * box_[i].magnitude() + kLeastTolerance;
  }
}

void ValidatedFlow::Solver::find_damping(const Interval& duration) {
  all_free_ = true;
  for (std::size_t i = 0; i < n_; ++i) {
    damped_[i] = !system_.stops.empty() && !is_free(system_.stops[i], now_[i], derivative_[i], duration);
    all_free_ = all_free_ && !damped_[i];
    ever_stopped_ = ever_stopped_ || damped_[i];
  }
}

/// @returns false if a shorter step is worth trying
bool ValidatedFlow::Solver::append_sensitivity(const Interval& duration, bool divisible) {
  jacobian_.evaluate(box_);
  note_rates();
  for (std::size_t i = 0; i < n_; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double strongest = jacobian_.state()(index, index).lower * duration.upper;
    if (strongest < -kStrongDecay) damped_[i] = true;
  }
  if (transition_.enclose(jacobian_.state(), duration, damped_)) {
    FlowStep& step = next_step();
    if (takes_long_steps_ && step.smooth && std::find(damped_.begin(), damped_.end(), true) == damped_.end())
      tangent_->narrow(now_, box_, duration, step.remainder.order, transition_);
    sensitivity_.append(transition_, jacobian_);
    step.transition = transition_.end();
    return true;
  }
  const bool small = duration.upper * kTicks <= period_.upper * kSmallWithoutBound;
  if (divisible && !small) return false;
  sensitivity_.lose();
  return true;
}

/// Where a component of f keeps its sign, the state moves one way, from `now_` to `next_`.
void ValidatedFlow::Solver::finish_step(bool last) {
  const FlowStep& step = steps_[step_count_ - 1];
  const Interval duration = step.duration;
  for (std::size_t i = 0; i < n_; ++i) {
    next_[i] = field_.clipped(i, now_[i] + duration * derivative_[i]);
    next_[i] = intersect(next_[i], box_[i]).value_or(next_[i]);
  }
  if (sensitivity_.is_bounded()) follow_extremes(last);
  for (std::size_t i = 0; i < n_; ++i) {
    // On the seam itself the equations see its other side: what may just have reached it must be beyond it.
    if (field_.has_seams(i) && derivative_[i].upper > 0.0) next_[i].upper = outward::next_up(next_[i].upper);
  }
  for (std::size_t i = 0; i < n_; ++i) {
    const bool is_monotone = derivative_[i].lower >= 0.0 || derivative_[i].upper <= 0.0;
    Interval during = is_monotone ? hull(now_[i], next_[i]) : box_[i];
    if (!is_monotone && takes_long_steps_ && step.smooth)
      during = intersect(during, hull(now_[i], next_[i]) + taylor_.bend(i, duration)).value_or(during);
    result_.tube[i] = hull(result_.tube[i], during);
    result_.drift[i] = result_.drift[i] + duration * hull(derivative_[i], Interval{});
  }
  now_ = next_;
  if (!sensitivity_.is_bounded()) restart();
}

/// Forgets how the box came about and goes on from it.
void ValidatedFlow::Solver::restart() {
  restarted_ = true;
  initial_ = now_;
  sensitivity_.reset();
  step_count_ = 0;
  solution_count_ = 0;
}

}  // namespace coordreq

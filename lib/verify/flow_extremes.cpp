#include "verify/flow_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "spec/system_spec.hpp"
#include "verify/piece_choices.hpp"

namespace coordreq {
namespace {

constexpr int kMostSteps = 128;
/// Tries for a step of the solution in the middle, which has to find where an equation has a kink.
constexpr int kTriesOfMiddle = 200;
constexpr int kSeveralSteps = 8;    ///< with fewer a tube is not narrowed
constexpr int kManySteps = 32;      ///< with fewer a solution in the middle need not be as exact
constexpr double kOfMiddle = 1e-2;  ///< tolerance of a solution around which others are, in cells

ArbMatrix columns(const ArbMatrix& a, std::size_t rows, std::size_t first, std::size_t count) {
  ArbMatrix result(rows, count);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < count; ++j) result.set(i, j, a(i, first + j));
  }
  return result;
}

bool same(const std::vector<Arb>& a, const std::vector<Arb>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Arb& x, const Arb& y) { return arb_equal(x.get(), y.get()) != 0; });
}

/// Work of the transition matrix of a step, and of the effect of disturbances in the step.
Work work_of_transition(std::size_t states, std::size_t disturbances) {
  constexpr std::size_t kProducts = 10;  // of matrices, for an exponential, about
  return static_cast<Work>(kProducts * states * states * (states + disturbances));
}

/// Narrows a tube around a solution from the middle of its start, which goes on from a point of the tube at
/// each step. From another one it differs by the transition matrices times their distance at the start (mean
/// value theorem), by what disturbances make of it, and by what was left out at the points.
class MiddleSolution {
 public:
  /// @param tolerance of the solution, for a step @param terms of its series
  MiddleSolution(Trajectory& trajectory, const SpanBox& start, const std::vector<std::uint32_t>& states,
                 const std::vector<std::uint32_t>& disturbances, Arb step, double tolerance, slong terms)
      : trajectory_(trajectory),
        states_(states),
        step_(std::move(step)),
        tolerance_(tolerance),
        terms_(terms),
        by_start_(states.size(), states.size()),
        distance_(states.size(), 1),
        disturbances_(disturbances.size()),
        disturbance_(disturbances.size(), 1),
        left_out_(states.size(), 1) {
    for (const ArbSpan& span : start) now_.push_back(span.middle());
    for (std::size_t j = 0; j < states.size(); ++j)
      distance_.set(j, 0, start[states[j]].all() - now_[states[j]]);
    for (std::size_t l = 0; l < disturbances.size(); ++l)
      disturbance_.set(l, 0, start[disturbances[l]].all() - now_[disturbances[l]]);
    arb_mat_one(by_start_.get());
  }

  /// Narrows the end of the next step, as long as all steps have slopes. @returns the work on matrices
  Work narrow(TubeStep& step) {
    is_known_ = is_known_ && step.slopes && advance(step.tube);
    if (!is_known_) return 0;
    const std::size_t n = states_.size(), m = disturbances_;
    const ArbMatrix by_state = columns(*step.slopes, n, 0, n);
    const ArbMatrix& moved = step.transition.emplace(transition_matrix(by_state, step_));
    by_start_ = moved * by_start_;
    left_out_ = moved * left_out_;
    // Each by itself: boxes would grow as they turn.
    for (Push& push : pushes_) push.since = moved * push.since;
    if (m > 0) {
      const ArbMatrix within = transition_matrix(by_state, hull(Arb(), step_));
      Push& push = pushes_.emplace_back(
          Push{ArbMatrix(n, n), within * (columns(*step.slopes, n, n, m) * disturbance_)});
      arb_mat_one(push.since.get());
      arb_mat_scalar_mul_arb(push.moved.get(), push.moved.get(), step_.get(), kArbBits);
    }
    ArbMatrix distance = by_start_ * distance_;
    for (const Push& push : pushes_) {
      const ArbMatrix moved_on = push.since * push.moved;
      arb_mat_add(distance.get(), distance.get(), moved_on.get(), kArbBits);
    }
    for (std::size_t i = 0; i < n; ++i) {
      Arb& now = now_[states_[i]];
      const Arb end = now + distance(i, 0) + left_out_(i, 0);
      ArbSpan& span = step.end[states_[i]];
      if (end.is_finite())
        span = {greater(span.lower, end.lower()).lower(), lesser(span.upper, end.upper()).upper()};
      // A point again, where the next tube begins; the rest is kept apart.
      const Arb middle = lesser(greater(now.middle(), span.lower), span.upper).middle();
      left_out_.set(i, 0, left_out_(i, 0) + (now - middle));
      now = middle;
    }
    return work_of_transition(n, m) + static_cast<Work>(pushes_.size() * n * n * (n + 1));
  }

 private:
  /// The effect of disturbances in a step.
  struct Push {
    ArbMatrix since;  ///< transition matrix of the steps behind it
    ArbMatrix moved;  ///< by how much, at its end
  };

  [[nodiscard]] bool advance(const ArbBox& tube) {
    constexpr double kNoLimit = std::numeric_limits<double>::max();
    std::optional<ArbBox> end = trajectory_.analytic_step(now_, tube, step_, kNoLimit, terms_);
    if (!end) return trajectory_.integrate(now_, step_, tolerance_, kTriesOfMiddle);
    now_ = std::move(*end);
    return true;
  }

  Trajectory& trajectory_;
  const std::vector<std::uint32_t>& states_;
  Arb step_;
  double tolerance_;
  slong terms_;
  ArbBox now_;
  ArbMatrix by_start_;
  ArbMatrix distance_;  ///< from the middle of the start
  std::size_t disturbances_;
  ArbMatrix disturbance_;     ///< from the middle of disturbances
  std::vector<Push> pushes_;  ///< [step]
  ArbMatrix left_out_;        ///< at points
  bool is_known_ = true;
};

}  // namespace

FlowExtremes::FlowExtremes(const SystemSpec& spec, const Influences& influences, double cell)
    : field_(spec, influences, influences.moving),
      trajectory_(field_),
      period_(spec.dynamics.period),
      cell_(cell) {
  for (const std::size_t j : influences.moving) {
    states_.push_back(spec.state_slot(j));
    const StateSpec& state = spec.states[j];
    StopLimits& limits = limits_.emplace_back();
    if (state.below == Outside::stop) limits.below = Arb(state.grid.first).lower();
    if (state.above == Outside::stop) limits.above = Arb(state.grid.last()).upper();
  }
  for (const std::size_t j : seams_that_jump(spec, influences)) {
    const StateSpec& state = spec.states[j];
    seams_.push_back({*row_of(influences, j), state.lower, state.upper});
  }
  for (const std::size_t l : influences.disturbances) disturbances_.push_back(spec.disturbance_slot(l));
}

Extremes FlowExtremes::extremes(std::size_t state, const Enough& enough) {
  const std::size_t steps = steps_.size();
  Extremes result{bound_after(steps, state, false), bound_after(steps, state, true)};
  if (enough(result.least.bound, result.greatest.bound)) return result;
  result.least = extreme_after(steps, state, false);
  if (!enough(result.least.bound, result.greatest.bound)) result.greatest = extreme_after(steps, state, true);
  return result;
}

bool FlowExtremes::has_extremes_on_faces() const {
  const auto is_wide_in = [this](std::uint32_t slot) { return box_[slot].width() > 0; };
  const auto has_slopes = [](const TubeStep& step) { return step.slopes.has_value(); };
  return std::ranges::all_of(states_, is_wide_in) && std::ranges::all_of(steps_, has_slopes);
}

bool FlowExtremes::enclose(const SpanBox& box, const Effort& effort) {
  box_ = box;
  effort_ = effort;
  field_.mind({});
  bool found = find_steps();
  if (!seams_.empty() && (!found || passes_a_seam())) {
    field_.mind(seams_);
    found = find_steps();
  }
  if (!found) return false;
  effort_.steps = static_cast<int>(steps_.size());
  step_ = period_ / Arb(static_cast<double>(effort_.steps));
  influences_.assign(steps_.size() + 1, std::nullopt);
  return true;
}

/// Where the slopes would turn things round within a step, more steps are taken.
bool FlowExtremes::find_steps() {
  const bool are_few = effort_.steps < kSeveralSteps;
  std::optional<std::vector<TubeStep>> steps;
  if (are_few) {
    steps = enclosed(effort_.steps);
  } else {  // one step shows how short they have to be
    steps = enclose_flow(field_, limits_, box_, period_ / Arb(static_cast<double>(effort_.steps)), 1, 1);
  }
  const std::optional<ArbMatrix> slopes = steps ? steps->front().slopes : field_.jacobian(all_of(box_));
  const int count = slopes ? steps_for(*slopes, effort_) : effort_.steps;
  if (!are_few || count > effort_.steps) steps = enclosed(count);
  if (steps) steps_ = std::move(*steps);
  return steps.has_value();
}

/// Then another formula holds. What only falls does not get to the upper end, from which it does not start.
bool FlowExtremes::passes_a_seam() const {
  return std::any_of(seams_.begin(), seams_.end(), [this](const Seam& seam) {
    return std::any_of(steps_.begin(), steps_.end(), [&](const TubeStep& step) {
      const Arb& tube = step.tube[states_[seam.state]];
      const Arb& change = step.change[seam.state];
      const bool above = !change.is_nonpositive() && tube.upper_rational() >= seam.upper;
      const bool below = !change.is_nonnegative() && tube.lower_rational() < seam.lower;
      return above || below;
    });
  });
}

std::optional<std::vector<TubeStep>> FlowExtremes::enclosed(int steps) {
  if (effort_.steps < kSeveralSteps) return enclose_flow(field_, limits_, box_, period_, steps, 1);
  MiddleSolution middle(trajectory_, box_, states_, disturbances_, period_ / Arb(static_cast<double>(steps)),
                        kOfMiddle * cell_ / steps, effort_.steps < kManySteps ? 4 : 6);
  const int pieces = disturbances_.empty() ? 1 : std::min(effort_.steps / 4, 8);
  return enclose_flow(field_, limits_, box_, period_, steps, pieces,
                      [&](TubeStep& step) { field_.add_work(middle.narrow(step)); });
}

int FlowExtremes::steps_for(const ArbMatrix& slopes, const Effort& effort) const {
  Arb norm;
  arb_mat_bound_inf_norm(arb_radref(norm.get()), columns(slopes, states_.size(), 0, states_.size()).get());
  const double turns = norm.upper().approximately() * period_.approximately();
  const double least = std::min(turns * std::max(1.0, effort.steps / 4.0), double{kMostSteps});
  return std::max(effort.steps, static_cast<int>(std::ceil(least)));
}

Extreme FlowExtremes::bound_after(std::size_t steps, std::size_t state, bool greatest) const {
  Extreme result;
  const ArbSpan& end = (steps == 0 ? box_ : steps_[steps - 1].end)[states_[state]];
  result.bound = greatest ? end.upper.upper() : end.lower.lower();
  for (const ArbSpan& span : box_) result.start.push_back(span.middle());
  for (const std::uint32_t slot : states_) result.excess.push_back(box_[slot].width());
  return result;
}

Extreme FlowExtremes::extreme_after(std::size_t steps, std::size_t state, bool greatest) {
  Extreme result = bound_after(steps, state, greatest);
  if (const std::optional<Influence>& influence = influence_after(steps))
    follow(*influence, state, greatest, result);
  return result;
}

const std::optional<FlowExtremes::Influence>& FlowExtremes::influence_after(std::size_t steps) {
  auto& known = influences_[steps];
  if (!known) known = find_influence(steps);
  return *known;
}

std::optional<FlowExtremes::Influence> FlowExtremes::find_influence(std::size_t steps) {
  const std::size_t n = states_.size();
  const std::size_t m = disturbances_.size();
  Influence result{.of_start = ArbMatrix(n, n)};
  arb_mat_one(result.of_start.get());
  result.of_disturbance.assign(steps, ArbMatrix(n, m));
  for (std::size_t k = steps; k-- > 0;) {
    if (!steps_[k].slopes) return std::nullopt;
    const ArbMatrix by_state = columns(*steps_[k].slopes, n, 0, n);
    if (!steps_[k].transition) {
      steps_[k].transition = transition_matrix(by_state, step_);
      field_.add_work(work_of_transition(n, 0));
    }
    if (m > 0) {
      field_.add_work(work_of_transition(n, m));
      const ArbMatrix within = result.of_start * transition_matrix(by_state, hull(Arb(), step_));
      result.of_disturbance[k] = within * columns(*steps_[k].slopes, n, n, m);
      if (arb_mat_is_finite(result.of_disturbance[k].get()) == 0) return std::nullopt;
    }
    result.of_start = result.of_start * *steps_[k].transition;
  }
  if (arb_mat_is_finite(result.of_start.get()) == 0) return std::nullopt;
  return result;
}

void FlowExtremes::follow(const Influence& influence, std::size_t state, bool greatest, Extreme& extreme) {
  Arb excess;
  for (std::size_t j = 0; j < states_.size(); ++j) {
    const EndChoice choice = choose_for_extreme(box_[states_[j]], influence.of_start(state, j), greatest);
    extreme.start[states_[j]] = choice.point;
    extreme.excess[j] = choice.excess.approximately();
    excess = excess + choice.excess;
  }
  std::vector<std::vector<Arb>> signal;
  for (const ArbMatrix& of_disturbance : influence.of_disturbance) {
    auto& now = signal.emplace_back();
    for (std::size_t l = 0; l < disturbances_.size(); ++l) {
      EndChoice choice = choose_for_extreme(box_[disturbances_[l]], of_disturbance(state, l), greatest);
      excess = excess + choice.excess * step_;
      now.push_back(std::move(choice.point));
    }
  }
  for (std::size_t l = 0; l < disturbances_.size() && !signal.empty(); ++l)
    extreme.start[disturbances_[l]] = signal.front()[l];
  ArbBox now = extreme.start;
  if (!move_on(now, signal)) return;
  const Arb& value = now[states_[state]];
  extreme.attained = value;
  const Arb bound = greatest ? (value + excess).upper() : (value - excess).lower();
  if (is_below(bound, extreme.bound) == greatest) extreme.bound = bound;
}

/// Follows a solution while disturbances take these values, one a step.
bool FlowExtremes::move_on(ArbBox& now, const std::vector<std::vector<Arb>>& signal) {
  const Arb all(static_cast<double>(effort_.steps));
  for (std::size_t begin = 0, end = 0; begin < signal.size(); begin = end) {
    while (end < signal.size() && same(signal[begin], signal[end])) ++end;
    for (std::size_t l = 0; l < disturbances_.size(); ++l) now[disturbances_[l]] = signal[begin][l];
    const Arb duration = period_ * Arb(static_cast<double>(end - begin)) / all;
    if (!trajectory_.advance(now, duration, effort_.tolerance * cell_)) return false;
  }
  return true;
}

}  // namespace coordreq

// Refines an enclosure where followed solutions do not come close to all of its ends.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/fast_paths.hpp"

#include "reach/flow_solver.hpp"

namespace coordreq {
namespace {

/// No box of initial states may take more steps, nor much longer than a second; it is tried with fewer first.
constexpr std::size_t kMostSteps = 30000;
constexpr std::size_t kFewSteps = 1000;
/// Decay by more powers of e in a period cannot be followed in as many.
constexpr double kTooStiff = 1e7;
/// The excess of an enclosure over followed solutions that is allowed, as a fraction of the initial box or of
/// the value itself.
constexpr double kTight = 0.2;
constexpr double kTightMagnitude = 1e-6;
/// The allowed excess of a state that starts from a point, as a fraction of a step of the grid.
constexpr double kTightStep = 0.1;
/// A fraction of the allowed excess below which no refinement is tried.
constexpr double kHardly = 0.1;
/// A box of initial states is halved so often at most.
constexpr int kMostSplits = 2;
/// A subbox that leads to more steps of the grid on its way is not followed further.
constexpr double kWidestSubbox = 100.0;
/// Patience is at an end where a box leads to more steps of the grid than indices of cells can tell apart.
constexpr double kAnywhere = 0x1p40;
/// The neighbourhood of a box: the distance from its ends, relative to them.
constexpr double kNeighbourhood = 1e-14;

template <class Combine>
void combine(FlowEnclosure& a, const FlowEnclosure& b, Combine both) {
  for (std::size_t i = 0; i < a.end.size(); ++i) {
    a.end[i] = both(a.end[i], b.end[i]);
    a.tube[i] = both(a.tube[i], b.tube[i]);
    a.drift[i] = both(a.drift[i], b.drift[i]);
  }
}

}  // namespace

const FlowEnclosure& ValidatedFlow::Solver::flow(std::span<const Interval> slots) {
  for (std::size_t i = 0; i < n_; ++i) {
    const double start = slots[system_.state_slots[i]].width();
    allowed_excess_[i] =
        start > 0.0 || system_.steps.empty() ? kTight * start : kTightStep * system_.steps[i];
  }
  result_.reached.clear();
  enclose(slots, fast_paths().halved_boxes ? kMostSplits : 0);
  return result_;
}

const FlowEnclosure& ValidatedFlow::Solver::flow_of_subbox(std::span<const Interval> slots, bool long_steps) {
  for (std::size_t i = 0; i < n_; ++i) {
    const double start = slots[system_.state_slots[i]].width();
    allowed_excess_[i] = system_.steps.empty() ? kTight * start : kTightStep * system_.steps[i];
  }
  result_.reached.clear();
  is_subbox_ = true;
  may_take_long_steps_ = long_steps && tangent_;
  enclose(slots, 0);
  is_subbox_ = may_take_long_steps_ = false;
  return result_;
}

/// Whether a subbox is so wide that smaller ones are better than to go on.
bool ValidatedFlow::Solver::is_too_wide() const {
  if (!is_subbox_ || system_.steps.empty()) return false;
  for (std::size_t i = 0; i < n_; ++i) {
    if (now_[i].width() > kWidestSubbox * system_.steps[i]) return true;
  }
  return false;
}

/// Whether some state can be anywhere, as after growth by many powers of e.
bool ValidatedFlow::Solver::is_anywhere() const {
  for (std::size_t i = 0; i < system_.steps.size(); ++i) {
    if (now_[i].width() > kAnywhere * system_.steps[i]) return true;
  }
  return false;
}

/// Takes down where solutions got to that have been followed from the start.
void ValidatedFlow::Solver::note_reached() {
  if (attained_.empty() || restarted_) return;
  if (result_.reached.empty()) result_.reached = attained_;
  for (std::size_t i = 0; i < n_; ++i) result_.reached[i] = hull(result_.reached[i], attained_[i]);
}

bool ValidatedFlow::Solver::keeps_apart(std::span<const Interval> box) {
  for (std::size_t i = 0; i < n_; ++i) {
    const double more = kNeighbourhood * box[i].magnitude() + std::numeric_limits<double>::min();
    box_[i] = {box[i].lower - more, box[i].upper + more};
    if (!box_[i].is_finite() || field_.has_seams(i)) return false;
    if (field_.meets_limit(i, box_[i])) return false;
  }
  if (field_.evaluate(box_, derivative_)) return false;
  jacobian_.evaluate(box_);
  const IntervalMatrix& slopes = jacobian_.state();
  return std::all_of(slopes.data(), slopes.data() + slopes.size(),
                     [](const Interval& a) { return a.is_finite(); }) &&
         (jacobian_.jump().array() == 0.0).all();
}

/// Puts an enclosure into `result_`.
void ValidatedFlow::Solver::enclose(std::span<const Interval> slots, int halvings) {
  begin(slots);
  const bool found = run_steps(kFewSteps, false);
  if (found) note_reached();
  result_.loosest = most_uncertain();
  if (found ? is_tight() : is_too_wide()) return;
  const bool divisible = found && is_smooth() && !restarted_;
  if (divisible) {
    if (halvings > 0) enclose_halves(slots, halvings - 1);
  } else if (!bound_by_faces(slots, found) && gave_up_ && !is_subbox_ &&
             fastest_decay_ * period_.upper < kTooStiff) {
    begin(slots);
    if (run_steps(kMostSteps, true)) note_reached();
  }
}

/// The excess over followed solutions that is allowed for state i; if it starts from a point, relative to the
/// result.
double ValidatedFlow::Solver::allowed_excess(std::size_t i) const {
  return allowed_excess_[i] > 0.0 ? allowed_excess_[i] : kTight * result_.end[i].width();
}

/// Whether solutions that were followed come close to all ends. Affine systems have their hull in any case.
bool ValidatedFlow::Solver::is_tight() const {
  if (tape_.affine && !ever_stopped_ && !restarted_) return true;
  if (restarted_ || attained_.empty()) return false;
  for (std::size_t i = 0; i < n_; ++i) {
    const double excess = std::max(result_.end[i].upper - attained_[i].upper, 0.0) +
                          std::max(attained_[i].lower - result_.end[i].lower, 0.0);
    const double magnitude = std::max(std::fabs(result_.end[i].lower), std::fabs(result_.end[i].upper));
    if (excess > allowed_excess(i) + kTightMagnitude * magnitude) return false;
  }
  return true;
}

/// Whether differences of solutions come from initial states, and hardly from disturbances and jumps.
bool ValidatedFlow::Solver::is_smooth() const {
  for (std::size_t i = 0; i < n_; ++i) {
    double other = sensitivity_.jump(i);
    for (std::size_t l = 0; l < m_; ++l) other += sensitivity_.weight(i, l) * disturbance_[l].width();
    if (other > kHardly * allowed_excess(i)) return false;
  }
  return true;
}

/// The hull of what both halves of the initial box lead to, if that can be found.
void ValidatedFlow::Solver::enclose_halves(std::span<const Interval> slots, int halvings) {
  const FlowEnclosure whole = result_;
  const std::uint32_t slot = system_.state_slots[most_uncertain()];
  const double middle = midpoint(slots[slot]);
  std::vector<Interval> half(slots.begin(), slots.end());
  half[slot].upper = middle;
  enclose(half, halvings);
  FlowEnclosure both = result_;
  if (both.status == FlowEnclosure::Status::ok) {
    half[slot] = {middle, slots[slot].upper};
    enclose(half, halvings);
    combine(both, result_, [](const Interval& a, const Interval& b) { return hull(a, b); });
  }
  const bool found = both.status == FlowEnclosure::Status::ok && result_.status == both.status;
  std::vector<Interval> reached = std::move(result_.reached);
  result_ = whole;
  result_.reached = std::move(reached);
  if (!found) return;
  combine(result_, both, [](const Interval& a, const Interval& b) { return intersect(a, b).value_or(a); });
}

/// The initial state whose sensitivities are least known, by what they add to the result.
std::size_t ValidatedFlow::Solver::most_uncertain() const {
  std::size_t result = 0;
  double largest = -1.0;
  for (std::size_t j = 0; j < n_; ++j) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double term = sensitivity_.initial(i, j).width() * initial_[j].width();
      sum += term / std::max(allowed_excess(i), 1e-300);
    }
    if (sum <= largest) continue;
    largest = sum;
    result = j;
  }
  return result;
}

/// Puts what is in both enclosures into the result. @returns whether there is one by faces
bool ValidatedFlow::Solver::bound_by_faces(std::span<const Interval> slots, bool found) {
  if (!fast_paths().face_flow) return false;
  for (std::size_t i = 0; i < n_; ++i) {
    if (field_.has_seams(i)) return false;
  }
  if (faces_.enclose(slots, field_, period_, by_faces_)) return false;
  if (found) {
    combine(result_, by_faces_,
            [](const Interval& a, const Interval& b) { return intersect(a, b).value_or(a); });
  } else {
    by_faces_.loosest = result_.loosest;
    by_faces_.in_long_steps = result_.in_long_steps;
    result_ = by_faces_;
  }
  return true;
}

}  // namespace coordreq

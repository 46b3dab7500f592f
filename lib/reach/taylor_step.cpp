#include "reach/taylor_step.hpp"

#include <algorithm>

namespace coordreq {
namespace {

/// Beyond this a smaller step is cheaper. Coefficients of affine systems cost next to nothing.
constexpr std::size_t kLargestOrder = 12;
constexpr std::size_t kLargestAffineOrder = 24;

/// A remainder that seems so many times as wide as half of the tolerance is hopeless: tolerances grow with
/// the box, by little.
constexpr double kHopeless = 2.0;

std::size_t largest_order(const FlowTape& tape) {
  return tape.affine ? kLargestAffineOrder : kLargestOrder;
}

}  // namespace

TaylorStep::TaylorStep(const FlowTape& tape)
    : dimension_(tape.outputs.size()),
      box_series_(tape, largest_order(tape)),
      state_series_(tape, largest_order(tape)),
      terms_(dimension_),
      sums_(dimension_) {}

void TaylorStep::begin(const VectorField& field, const Choices& choices, const std::vector<bool>& held) {
  box_series_.start(field.values(), choices, held);
  box_series_.add_box(field.slots(), &field.values());
}

void TaylorStep::find_remainder(const Interval& duration, std::span<const double> tolerance,
                                TaylorRemainder& remainder) {
  remainder.order = 0;
  remainder.bounded = true;
  remainder.value.resize(dimension_);
  const Ball step = to_ball(duration);
  Ball power = to_ball(1.0);
  while (box_series_.order() < box_series_.largest_order()) {
    box_series_.extend();
    power = power * step;
    remainder.bounded = is_bounded(power);
    if (!remainder.bounded) return;
    if (box_series_.order() > 1 && is_narrow(tolerance, remainder.value)) {
      remainder.order = box_series_.order();
      for (std::size_t i = 0; i < dimension_ && box_series_.lanes() > 1; ++i)
        sums_[i] = box_series_.polynomials(i, remainder.order, step);
      return;
    }
  }
}

bool TaylorStep::could_be_doubled(const Interval& duration, std::span<const double> tolerance) {
  while (box_series_.order() < box_series_.largest_order()) box_series_.extend();
  double power = 1.0;
  for (std::size_t k = 1; k <= box_series_.largest_order(); ++k) {
    power *= 2.0 * duration.lower;
    if (k == 1) continue;
    bool narrow = true;
    for (std::size_t i = 0; i < dimension_; ++i)
      narrow = narrow && power * box_series_.coefficient(0, i, k).radius <= kHopeless * tolerance[i];
    if (narrow) return true;
  }
  return false;
}

/// A coefficient without a bound makes all that follow so.
bool TaylorStep::is_bounded(const Ball& power) {
  bool bounded = true;
  for (std::size_t i = 0; i < dimension_; ++i) {
    terms_[i] = power * box_series_.coefficient(0, i, box_series_.order());
    bounded = bounded && terms_[i].radius <= outward::kLargest;
  }
  return bounded;
}

bool TaylorStep::is_narrow(std::span<const double> tolerance, std::vector<Interval>& value) const {
  for (std::size_t i = 0; i < dimension_; ++i) {
    if (!(2.0 * terms_[i].radius <= tolerance[i])) return false;
  }
  for (std::size_t i = 0; i < dimension_; ++i) value[i] = to_interval(terms_[i]);
  return true;
}

void TaylorStep::advance_along(std::size_t along, const TaylorRemainder& remainder,
                               std::span<Interval> state) const {
  const std::size_t lane = along + 1;
  for (std::size_t i = 0; i < dimension_; ++i)
    state[i] = to_interval({sums_[i].middle[lane], sums_[i].radius[lane]}) + remainder.value[i];
}

void TaylorStep::advance(VectorField& field, const Interval& duration, const Choices& choices,
                         const std::vector<bool>& held, const TaylorRemainder& remainder,
                         std::span<Interval> state) {
  field.set_state(state);
  state_series_.start(field.values(), choices, held);
  state_series_.add_box(field.slots());
  while (state_series_.order() + 1 < remainder.order) state_series_.extend();
  const Ball step = to_ball(duration);
  for (std::size_t i = 0; i < dimension_; ++i) {
    const BallLanes sums = state_series_.polynomials(i, remainder.order, step);
    state[i] = to_interval({sums.middle[0], sums.radius[0]}) + remainder.value[i];
  }
}

}  // namespace coordreq

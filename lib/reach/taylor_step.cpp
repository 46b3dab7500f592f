#include "reach/taylor_step.hpp"

#include <algorithm>

namespace coordreq {
namespace {

/// Beyond this a smaller step is cheaper. Coefficients of affine systems cost next to nothing.
constexpr std::size_t kLargestOrder = 12;
constexpr std::size_t kLargestAffineOrder = 24;

std::size_t largest_order(const FlowTape& tape) {
  return tape.affine ? kLargestAffineOrder : kLargestOrder;
}

}  // namespace

TaylorStep::TaylorStep(const FlowTape& tape)
    : dimension_(tape.outputs.size()),
      over_box_(tape, largest_order(tape)),
      at_state_(tape, largest_order(tape)) {}

void TaylorStep::find_remainder(const VectorField& field, const Interval& duration, const Choices& choices,
                                const std::vector<bool>& held, std::span<const double> tolerance,
                                TaylorRemainder& remainder) {
  remainder.order = 0;
  remainder.bounded = true;
  remainder.value.resize(dimension_);
  over_box_.start(field.slots(), field.values(), choices, held);
  const Ball step = to_ball(duration);
  Ball power = to_ball(1.0);
  while (over_box_.order() < over_box_.largest_order()) {
    over_box_.extend();
    power = power * step;
    remainder.bounded = is_bounded(power);
    if (!remainder.bounded) return;
    if (over_box_.order() > 1 && is_narrow(power, tolerance, remainder.value)) {
      remainder.order = over_box_.order();
      return;
    }
  }
}

/// A coefficient without a bound makes all that follow so.
bool TaylorStep::is_bounded(const Ball& power) const {
  for (std::size_t i = 0; i < dimension_; ++i) {
    if (!((power * over_box_.coefficient(i, over_box_.order())).radius <= outward::kLargest)) return false;
  }
  return true;
}

bool TaylorStep::is_narrow(const Ball& power, std::span<const double> tolerance,
                           std::vector<Interval>& value) const {
  for (std::size_t i = 0; i < dimension_; ++i) {
    const Ball term = power * over_box_.coefficient(i, over_box_.order());
    if (!(2.0 * term.radius <= tolerance[i])) return false;
    value[i] = to_interval(term);
  }
  return true;
}

void TaylorStep::advance(VectorField& field, const Interval& duration, const Choices& choices,
                         const std::vector<bool>& held, const TaylorRemainder& remainder,
                         std::span<Interval> state) {
  field.set_state(state);
  at_state_.start(field.slots(), field.values(), choices, held);
  while (at_state_.order() + 1 < remainder.order) at_state_.extend();
  const Ball step = to_ball(duration);
  for (std::size_t i = 0; i < dimension_; ++i) {
    state[i] = to_interval(at_state_.polynomial(i, remainder.order, step)) + remainder.value[i];
  }
}

}  // namespace coordreq

#include "reach/taylor_step.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

/// Beyond this a smaller step is cheaper. Coefficients of affine systems cost next to nothing.
constexpr std::size_t kLargestOrder = 12;
constexpr std::size_t kLargestAffineOrder = 24;

/// A remainder that seems so many times as wide as half of the tolerance is hopeless: tolerances grow with
/// the box, by little.
constexpr double kHopeless = 2.0;

/// An entry of a transition matrix that is no wider is known well enough.
constexpr double kNarrow = 0x1p-40;

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

/// A function of time differs from its chord by at most h^2 / 8 times its second derivative.
Interval TaylorStep::bend(std::size_t i, const Interval& duration) const {
  const double most = to_interval(box_series_.coefficient(0, i, 2)).magnitude();
  const Interval time{0.0, duration.upper};
  return time * time * Interval{-most, most} * Interval(0.25);
}

TangentStep::TangentStep(FlowTape tape, const FlowSystem& system)
    : dimension_(system.equations.size()),
      tape_(std::move(tape)),
      fixed_(tape_),
      series_(tape_, largest_order(tape_)),
      slots_(system.slot_count + dimension_),
      choices_(tape_.nodes.size()),
      none_held_(2 * dimension_) {}

void TangentStep::begin(std::span<const Interval> slots) {
  std::copy(slots.begin(), slots.end(), slots_.begin());
  fixed_.run_fixed(slots_);
}

void TangentStep::narrow(std::span<const Interval> start, std::span<const Interval> box,
                         const Interval& duration, std::size_t order, TransitionMatrix& transition) {
  columns_.clear();
  for (Eigen::Index j = 0; j < transition.end().cols(); ++j) {
    const auto is_narrow = [](const UpwardInterval& a) { return a.upper() - a.lower() <= kNarrow; };
    if (!transition.end().col(j).unaryExpr(is_narrow).all()) columns_.push_back(j);
  }
  const Ball step = to_ball(duration);
  Ball power = step;
  for (std::size_t k = 1; k < order; ++k) power = power * step;
  constexpr std::size_t kAtOnce = TaylorSeries::kLanes / 2;
  for (std::size_t first = 0; first < columns_.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, columns_.size() - first);
    series_.start(fixed_, choices_, none_held_);
    for (std::size_t c = 0; c < count; ++c) add_lanes(start, box, transition, columns_[first + c]);
    while (series_.order() < order) series_.extend();
    for (std::size_t i = 0; i < dimension_; ++i) {
      const BallLanes sums = series_.polynomials(dimension_ + i, order, step);
      for (std::size_t c = 0; c < count; ++c) {
        const Ball rest = power * series_.coefficient(2 * c + 1, dimension_ + i, order);
        transition.narrow_end(static_cast<Eigen::Index>(i), columns_[first + c],
                              to_interval({sums.middle[2 * c], sums.radius[2 * c]}) + to_interval(rest));
      }
    }
  }
}

/// The polynomial is of solutions from the start, the remainder of all that they pass.
void TangentStep::add_lanes(std::span<const Interval> start, std::span<const Interval> box,
                            const TransitionMatrix& transition, Eigen::Index column) {
  const auto n = static_cast<Eigen::Index>(dimension_);
  Interval* const tangent = slots_.data() + slots_.size() - dimension_;
  for (Eigen::Index i = 0; i < n; ++i) tangent[i] = Interval(i == column ? 1.0 : 0.0);
  add_lane(start);
  for (Eigen::Index i = 0; i < n; ++i) tangent[i] = transition.range()(i, column).interval();
  add_lane(box);
}

void TangentStep::add_lane(std::span<const Interval> state) {
  for (std::size_t i = 0; i < dimension_; ++i) slots_[tape_.state_slots[i]] = state[i];
  series_.add_box(slots_);
}

}  // namespace coordreq

#include "reach/taylor_series.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

using Rule = FlowTape::Rule;

SeriesStep step_of(Rule rule) {
  switch (rule) {
    case Rule::variable:
      return SeriesStep::input;
    case Rule::sum:
      return SeriesStep::sum;
    case Rule::difference:
      return SeriesStep::difference;
    case Rule::negation:
      return SeriesStep::negation;
    case Rule::product:
      return SeriesStep::product;
    case Rule::quotient:
      return SeriesStep::quotient;
    case Rule::chain:
      return SeriesStep::chain;
    case Rule::inverse_chain:
      return SeriesStep::inverse_chain;
    case Rule::root:
      return SeriesStep::root;
    case Rule::power:
      return SeriesStep::power;
    case Rule::angle:
      return SeriesStep::angle;
    case Rule::pick:
    case Rule::fixed:
      break;
  }
  return SeriesStep::zero;
}

void put(const Ball& value, std::size_t lane, BallLanes& balls) {
  balls.middle[lane] = value.middle;
  balls.radius[lane] = value.radius;
}

BallLanes in_all_lanes(const Ball& value) {
  BallLanes balls;
  for (std::size_t lane = 0; lane < BallLanes::kLanes; ++lane) put(value, lane, balls);
  return balls;
}

}  // namespace

TaylorSeries::TaylorSeries(const FlowTape& tape, std::size_t largest_order)
    : tape_(&tape), kernels_(&taylor_kernels()), has_value_(tape.nodes.size()) {
  for (const std::uint32_t i : tape.values) has_value_[i] = true;
  for (const std::uint32_t i : tape.series) {
    if (tape.nodes[i].is_choice()) choice_nodes_.push_back(nodes_.size());
    nodes_.push_back(node_of(i));
  }
  for (const std::uint32_t i : tape.outputs) outputs_.push_back({.node = i, .moves = moves(i)});
  mark_weighted();
  memory_.stride = largest_order + 1;
  memory_.lanes = 0;
}

SeriesNode TaylorSeries::node_of(std::uint32_t i) const {
  const FlowTape::Node& node = tape_->nodes[i];
  SeriesNode result{.step = step_of(node.rule), .self = i, .p = node.p, .q = node.q, .square = node.square};
  if (node.rule == Rule::variable) {
    if (node.p == FlowTape::kNone) result.step = SeriesStep::zero;
    return result;
  }
  result.p_moves = moves(node.p);
  result.q_moves = moves(node.q);
  result.square_moves = moves(node.square);
  return result;
}

void TaylorSeries::mark_weighted() {
  std::vector<bool> weighted(tape_->nodes.size());
  for (const SeriesNode& node : nodes_) {
    if (node.step == SeriesStep::chain) weighted[node.p] = true;
    if (node.step == SeriesStep::inverse_chain) weighted[node.self] = true;
  }
  for (SeriesNode& node : nodes_) node.weighted = weighted[node.self];
}

/// Not before it is needed: not all series are.
void TaylorSeries::allocate() {
  if (!coefficients_.empty()) return;
  const std::size_t size = tape_->nodes.size() * memory_.stride;
  values_.resize(tape_->nodes.size());
  coefficients_.resize(size);
  if (std::any_of(nodes_.begin(), nodes_.end(), [](const SeriesNode& node) { return node.weighted; }))
    weighted_.resize(size);
  states_.resize(outputs_.size() * memory_.stride);
  last_nonzero_.resize(kLanes / 2 * tape_->nodes.size());
  memory_.nodes = nodes_.data();
  memory_.node_count = nodes_.size();
  memory_.outputs = outputs_.data();
  memory_.state_count = outputs_.size();
  memory_.coefficients = coefficients_.data();
  memory_.weighted = weighted_.data();
  memory_.states = states_.data();
  memory_.last_nonzero = last_nonzero_.data();
  memory_.tape_size = tape_->nodes.size();
}

void TaylorSeries::start(const TapeValues<Interval>& fixed, const Choices& choices,
                         const std::vector<bool>& held) {
  allocate();
  choices_ = &choices;
  order_ = 0;
  memory_.lanes = 0;
  for (const std::uint32_t i : tape_->fixed_values) {
    values_[i] = fixed[i];
    coefficients_[i * memory_.stride] = in_all_lanes(to_ball(values_[i]));
  }
  for (const std::size_t n : choice_nodes_) make_choice(nodes_[n]);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    outputs_[i].held = held[i];
    states_[i * memory_.stride] = {};
  }
  for (const std::uint32_t i : tape_->series) coefficients_[i * memory_.stride] = {};
  std::fill(last_nonzero_.begin(), last_nonzero_.end(), 0);
}

void TaylorSeries::make_choice(SeriesNode& node) const {
  if (tape_->nodes[node.self].rule == Rule::angle) {
    node.step = is_pinned_angle(node.self) ? SeriesStep::zero : SeriesStep::angle;
    return;
  }
  const FlowTape::Node& pick = tape_->nodes[node.self];
  const Choice::Kind kind = (*choices_)[node.self].kind;
  node.p = kind == Choice::Kind::second ? pick.q : pick.p;
  node.p_moves = moves(node.p);
  node.step = kind == Choice::Kind::first_negated                           ? SeriesStep::negation
              : kind == Choice::Kind::first || kind == Choice::Kind::second ? SeriesStep::same
                                                                            : SeriesStep::zero;
}

void TaylorSeries::add_box(std::span<const Interval> slots, const TapeValues<Interval>* known) {
  REQUIRES(lanes() < kLanes && order_ == 0);
  const std::size_t lane = memory_.lanes++;
  for (std::size_t i = 0; i < tape_->state_slots.size(); ++i)
    put(to_ball(slots[tape_->state_slots[i]]), lane, states_[i * memory_.stride]);
  // Choices may be pinned to what the values of the tape leave open.
  const bool use_known = known != nullptr && choice_nodes_.empty();
  rounded_upward([&] {
    for (const std::uint32_t i : tape_->series)
      values_[i] = use_known && has_value_[i] ? (*known)[i] : value_of(i, slots);
  });
  put_values(lane);
}

/// Order 0 of a lane: the balls around the values, as to_ball() makes them.
void TaylorSeries::put_values(std::size_t lane) {
  for (const std::uint32_t i : tape_->series)
    coefficients_[i * memory_.stride].middle[lane] = midpoint(values_[i]);
  rounded_upward([&] {
    for (const std::uint32_t i : tape_->series) {
      BallLanes& balls = coefficients_[i * memory_.stride];
      const double middle = balls.middle[lane];
      balls.radius[lane] = std::max(values_[i].upper - middle, middle - values_[i].lower);
    }
  });
}

/// Rounded upward.
Interval TaylorSeries::value_of(std::uint32_t i, std::span<const Interval> slots) const {
  const FlowTape::Node& node = tape_->nodes[i];
  if (node.rule == Rule::variable) return slots[node.a];
  if (node.rule == Rule::pick) return picked_value(i);
  if (is_pinned_angle(i)) return (*choices_)[i].value;
  if (is_unary_function(node.op)) return apply_upward(node.op, values_[node.a]);
  return apply_upward(node.op, values_[node.a], values_[node.b]);
}

bool TaylorSeries::is_pinned_angle(std::uint32_t i) const {
  return tape_->nodes[i].rule == Rule::angle && (*choices_)[i].kind == Choice::Kind::pinned;
}

Interval TaylorSeries::picked_value(std::uint32_t i) const {
  const FlowTape::Node& node = tape_->nodes[i];
  const Choice& choice = (*choices_)[i];
  switch (choice.kind) {
    case Choice::Kind::first:
      return values_[node.p];
    case Choice::Kind::second:
      return values_[node.q];
    case Choice::Kind::first_negated:
      return -values_[node.p];
    default:
      return choice.value;
  }
}

void TaylorSeries::extend() {
  REQUIRES(order_ < largest_order() && lanes() > 0);
  kernels_->extend(memory_, order_);
  ++order_;
}

BallLanes TaylorSeries::polynomials(std::size_t state, std::size_t order, const Ball& duration) const {
  BallLanes sum;
  kernels_->polynomial(memory_, state, order, in_all_lanes(duration), sum);
  return sum;
}

}  // namespace coordreq

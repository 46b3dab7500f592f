#include "reach/taylor_series.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

using Rule = FlowTape::Rule;

constexpr Ball kZero{};

Ball as_ball(double value) {
  return {value, 0.0};
}
Ball as_ball(std::size_t value) {
  return as_ball(static_cast<double>(value));
}

}  // namespace

TaylorSeries::TaylorSeries(const FlowTape& tape, std::size_t largest_order)
    : tape_(&tape),
      stride_(largest_order + 1),
      values_(tape.nodes.size()),
      nodes_(tape.nodes.size() * stride_),
      states_(tape.outputs.size() * stride_),
      last_nonzero_(tape.nodes.size()) {}

void TaylorSeries::start(std::span<const Interval> slots, const TapeValues<Interval>& fixed,
                         const Choices& choices, const std::vector<bool>& held) {
  choices_ = &choices;
  held_ = &held;
  order_ = 0;
  for (const std::uint32_t i : tape_->fixed_values) {
    values_[i] = fixed[i];
    at(i, 0) = to_ball(values_[i]);
  }
  for (std::size_t i = 0; i < tape_->state_slots.size(); ++i) {
    states_[i * stride_] = to_ball(slots[tape_->state_slots[i]]);
  }
  for (const std::uint32_t i : tape_->series) {
    values_[i] = value_of(i, slots);
    at(i, 0) = to_ball(values_[i]);
    last_nonzero_[i] = 0;
  }
}

Interval TaylorSeries::value_of(std::uint32_t i, std::span<const Interval> slots) const {
  const FlowTape::Node& node = tape_->nodes[i];
  if (node.rule == Rule::variable) return slots[node.a];
  if (node.rule == Rule::pick) return picked_value(i);
  if (is_pinned_angle(i)) return (*choices_)[i].value;
  if (is_unary_function(node.op)) return apply(node.op, values_[node.a]);
  return apply(node.op, values_[node.a], values_[node.b]);
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
  REQUIRES(order_ < largest_order());
  const std::size_t k = order_;
  if (k > 0) {
    for (const std::uint32_t i : tape_->series) {
      const Ball value = next(i, k);
      at(i, k) = value;
      if (!value.is_zero()) last_nonzero_[i] = k;
    }
  }
  order_ = k + 1;
  set_state_coefficients(order_);
}

void TaylorSeries::set_state_coefficients(std::size_t k) {
  for (std::size_t i = 0; i < tape_->outputs.size(); ++i) {
    const std::uint32_t output = tape_->outputs[i];
    Ball& coefficient = states_[i * stride_ + k];
    const bool constant = (*held_)[i] || (k > 1 && !moves(output));
    coefficient = constant ? kZero : at(output, k - 1);
    if (k > 1 && !coefficient.is_zero()) coefficient = coefficient / as_ball(k);
  }
}

Ball TaylorSeries::polynomial(std::size_t state, std::size_t order, const Ball& duration) const {
  Ball sum = kZero;
  for (std::size_t k = order; k-- > 0;) {
    const Ball& next_coefficient = coefficient(state, k);
    sum = sum.is_zero() ? next_coefficient : sum * duration + next_coefficient;
  }
  return sum;
}

Ball TaylorSeries::picked(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  const auto of = [&](std::uint32_t operand) { return moves(operand) ? at(operand, k) : kZero; };
  switch ((*choices_)[i].kind) {
    case Choice::Kind::first:
      return of(node.p);
    case Choice::Kind::second:
      return of(node.q);
    case Choice::Kind::first_negated:
      return -of(node.p);
    default:
      return kZero;
  }
}

Ball TaylorSeries::next(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  const auto of = [&](std::uint32_t operand) { return moves(operand) ? at(operand, k) : kZero; };
  switch (node.rule) {
    case Rule::variable:
      return node.p == FlowTape::kNone ? kZero : coefficient(node.p, k);
    case Rule::sum:
      return of(node.p) + of(node.q);
    case Rule::difference:
      return of(node.p) - of(node.q);
    case Rule::negation:
      return -of(node.p);
    case Rule::product:
      return node.p == node.q ? square(node.p, k) : convolution(node.p, node.q, k, 0, k);
    case Rule::quotient:
      return quotient(i, k);
    case Rule::chain:
      return chain(i, k);
    case Rule::inverse_chain:
      return inverse_chain(i, k);
    case Rule::root:
      return (of(node.p) - convolution(i, i, k, 1, k - 1)) / (as_ball(2.0) * at(i, 0));
    case Rule::power:
      return power(i, k);
    case Rule::angle:
      return is_pinned_angle(i) ? kZero : angle(i, k);
    case Rule::pick:
      return picked(i, k);
    case Rule::fixed:
      break;
  }
  return kZero;
}

/// sum of p_j q_{k-j} over first <= j <= last.
Ball TaylorSeries::convolution(std::uint32_t p, std::uint32_t q, std::size_t k, std::size_t first,
                               std::size_t last) {
  const std::size_t p_last = moves(p) ? last_nonzero_[p] : 0;
  const std::size_t q_last = moves(q) ? last_nonzero_[q] : 0;
  // Order k of an operand is known already where it counts, but only recorded after this node's turn if the
  // operand is the node itself, which `first` and `last` exclude.
  const std::size_t from = std::max(first, k > q_last ? k - q_last : 0);
  const std::size_t to = std::min(last, p_last);
  Ball sum = kZero;
  for (std::size_t j = from; j <= to && j <= k; ++j) {
    const Ball& a = at(p, j);
    const Ball& b = at(q, k - j);
    if (!a.is_zero() && !b.is_zero()) sum = sum + a * b;
  }
  return sum;
}

Ball TaylorSeries::square(std::uint32_t p, std::size_t k) {
  const std::size_t last = moves(p) ? last_nonzero_[p] : 0;
  Ball sum = kZero;
  for (std::size_t j = k > last ? k - last : 0; 2 * j < k; ++j) sum = sum + at(p, j) * at(p, k - j);
  sum = sum + sum;
  return k % 2 == 0 && k / 2 <= last ? sum + at(p, k / 2) * at(p, k / 2) : sum;
}

/// q r = p.
Ball TaylorSeries::quotient(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  const Ball dividend = moves(node.p) ? at(node.p, k) : kZero;
  const Ball known = convolution(node.q, i, k, 1, k);
  const Ball rest = dividend - known;
  return rest.is_zero() ? kZero : rest / at(node.q, 0);
}

/// k r_k = sum of j p_j q_{k-j} over j >= 1.
Ball TaylorSeries::chain(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  const std::size_t q_last = moves(node.q) ? last_nonzero_[node.q] : 0;
  const std::size_t p_last = std::min(k, moves(node.p) ? last_nonzero_[node.p] : 0);
  Ball sum = kZero;
  for (std::size_t j = std::max<std::size_t>(1, k > q_last ? k - q_last : 0); j <= p_last; ++j) {
    sum = sum + as_ball(j) * at(node.p, j) * at(node.q, k - j);
  }
  return sum.is_zero() ? kZero : sum / as_ball(k);
}

/// k q_0 r_k = k p_k - sum of j r_j q_{k-j} over 1 <= j < k.
Ball TaylorSeries::inverse_chain(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  Ball sum = as_ball(k) * (moves(node.p) ? at(node.p, k) : kZero);
  const std::size_t q_last = moves(node.q) ? last_nonzero_[node.q] : 0;
  for (std::size_t j = std::max<std::size_t>(1, k > q_last ? k - q_last : 0); j < k; ++j) {
    sum = sum - as_ball(j) * at(i, j) * at(node.q, k - j);
  }
  return sum.is_zero() ? kZero : sum / (as_ball(k) * at(node.q, 0));
}

/// p r' = q r p' for a fixed exponent q: k p_0 r_k = sum of ((q + 1) j - k) p_j r_{k-j} over 1 <= j <= k.
Ball TaylorSeries::power(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  const Ball exponent = at(node.q, 0) + as_ball(1.0);
  Ball sum = kZero;
  for (std::size_t j = 1; j <= std::min(k, last_nonzero_[node.p]); ++j) {
    const Ball factor = exponent * as_ball(j) - as_ball(k);
    sum = sum + factor * at(node.p, j) * at(i, k - j);
  }
  return sum.is_zero() ? kZero : sum / (as_ball(k) * at(node.p, 0));
}

/// s = p^2 + q^2: k s_0 r_k = sum of j (p_j q_{k-j} - q_j p_{k-j}) over 1 <= j <= k, less the sum of j r_j
/// s_{k-j} over 1 <= j < k.
Ball TaylorSeries::angle(std::uint32_t i, std::size_t k) {
  const FlowTape::Node& node = tape_->nodes[i];
  const auto of = [&](std::uint32_t operand, std::size_t order) {
    return order == 0 || moves(operand) ? at(operand, order) : kZero;
  };
  Ball sum = kZero;
  for (std::size_t j = 1; j <= k; ++j) {
    Ball term = of(node.p, j) * of(node.q, k - j) - of(node.q, j) * of(node.p, k - j);
    if (j < k) term = term - at(i, j) * of(node.square, k - j);
    sum = sum + as_ball(j) * term;
  }
  return sum.is_zero() ? kZero : sum / (as_ball(k) * at(node.square, 0));
}

}  // namespace coordreq

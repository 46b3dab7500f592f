// A series by one term more: see ExpressionSeries::extend().

#include <algorithm>

#include "base/requires.hpp"
#include "verify/expression_series.hpp"

namespace coordreq {
namespace {

/// Term k of a * b.
Arb product_term(const ArbSeries& a, const ArbSeries& b, slong k) {
  const slong first = std::max<slong>(0, k + 1 - arb_poly_length(b.get()));
  const slong end = std::min(k + 1, arb_poly_length(a.get()));
  Arb sum;
  if (first < end)
    arb_dot(sum.get(), nullptr, 0, a.get()->coeffs + first, 1, b.get()->coeffs + (k - first), -1, end - first,
            kArbBits);
  return sum;
}

}  // namespace

const ArbSeries& ExpressionSeries::extend(std::span<const ArbSeries> slots, slong length) {
  REQUIRES(length >= 2);
  for (std::size_t n = 0; n < values_.size(); ++n) {
    if (is_condition(program_->nodes[n].op)) continue;  // they depend on constant terms alone
    if (is_extended(n)) {
      extend_number(n, slots, length - 1);
    } else {
      run_number(n, slots, length);
    }
  }
  return values_.back();
}

bool ExpressionSeries::is_extended(std::size_t n) const {
  const Program::Node& node = program_->nodes[n];
  if (node.op == Operator::power) {
    const Program::Node& exponent = program_->nodes[node.b];
    return exponent.op == Operator::constant && program_->constants[exponent.a] == 2;
  }
  return node.op <= Operator::divide || node.op == Operator::negate;
}

/// Term k >= 1 of a node, from terms up to k of its operands.
void ExpressionSeries::extend_number(std::size_t n, std::span<const ArbSeries> slots, slong k) {
  const Program::Node& node = program_->nodes[n];
  if (node.op == Operator::constant) return;
  const ArbSeries& a = node.op == Operator::variable ? slots[node.a] : values_[node.a];
  Arb term;
  switch (node.op) {
    case Operator::add:
      term = a[k] + values_[node.b][k];
      break;
    case Operator::subtract:
      term = a[k] - values_[node.b][k];
      break;
    case Operator::multiply:
      term = product_term(a, values_[node.b], k);
      break;
    case Operator::power:
      term = product_term(a, a, k);
      break;
    case Operator::divide: {  // term k of b * result is that of a, which so far has no part of b[0]
      const ArbSeries& b = values_[node.b];
      values_[n].set(k, Arb());
      term = (a[k] - product_term(b, values_[n], k)) / b[0];
      break;
    }
    case Operator::negate:
      arb_neg(term.get(), a[k].get());
      break;
    default:
      term = a[k];
      break;
  }
  values_[n].set(k, term);
}

}  // namespace coordreq

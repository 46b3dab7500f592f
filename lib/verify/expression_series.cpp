#include "verify/expression_series.hpp"

#include <algorithm>

namespace coordreq {
namespace {

constexpr slong kMostPower = 64;

Arb constant_term(const ArbSeries& a) {
  return a[0];
}

/// [0, 1] or [-1, 1].
Arb unit_range(bool both_sides) {
  return hull(Arb(both_sides ? -1.0 : 0.0), Arb(1.0));
}

/// |a|, without what rounding a ball adds below 0.
Arb absolute(const Arb& a) {
  if (a.is_nonnegative()) return a;
  if (a.is_nonpositive()) return Arb(0.0) - a;
  return hull(Arb(0.0), greater(a.upper(), Arb(0.0) - a.lower()));
}

/// Whether it matters that a ball is not the product of one number with itself.
bool is_wide(const Arb& a) {
  return a.width() > 1e-3 * std::abs(a.approximately());
}

/// Comparisons are decided where no point of the balls is on the other side.
Truth compare(Operator op, const Arb& a, const Arb& b) {
  const auto decided = [](bool yes, bool no) { return yes ? Truth::yes : no ? Truth::no : Truth::undecided; };
  switch (op) {
    case Operator::less:
      return decided(arb_lt(a.get(), b.get()) != 0, arb_ge(a.get(), b.get()) != 0);
    case Operator::less_equal:
      return decided(arb_le(a.get(), b.get()) != 0, arb_gt(a.get(), b.get()) != 0);
    case Operator::greater:
      return compare(Operator::less, b, a);
    case Operator::greater_equal:
      return compare(Operator::less_equal, b, a);
    case Operator::equal:
      return decided(arb_eq(a.get(), b.get()) != 0, arb_ne(a.get(), b.get()) != 0);
    default:
      return !compare(Operator::equal, a, b);
  }
}

/// Rounding a ball widens it by some 2^-30 of its radius: no reason to call a root undefined that begins at
/// 0.
bool is_nonnegative_before_rounding(const Arb& a) {
  return a.is_nonnegative() || -a.lower().approximately() <= 1e-7 * a.width();
}

/// a^p of the part of `a` that is not negative, p > 0.
Arb positive_power(const Arb& a, const Arb& p) {
  Arb most;
  arb_pow(most.get(), a.upper().get(), p.get(), kArbBits);
  Arb least(0.0);
  if (arb_is_positive(a.get()) != 0) arb_pow(least.get(), a.lower().get(), p.get(), kArbBits);
  return hull(least, most);
}

}  // namespace

ExpressionSeries::ExpressionSeries(const Program& program)
    : program_(&program), values_(program.nodes.size()), truths_(program.nodes.size()) {
  for (std::size_t n = 0; n < program.nodes.size(); ++n) {
    const Program::Node& node = program.nodes[n];
    if (node.op == Operator::constant) values_[n].assign(Arb(program.constants[node.a]));
  }
}

const ArbSeries& ExpressionSeries::operator()(std::span<const ArbSeries> slots, slong length) {
  smoothness_ = Smoothness::analytic;
  for (std::size_t n = 0; n < values_.size(); ++n) {
    if (is_condition(program_->nodes[n].op)) {
      truths_[n] = condition(n);
    } else {
      run_number(n, slots, length);
    }
  }
  return values_.back();
}

void ExpressionSeries::lose(Smoothness smoothness) {
  smoothness_ = std::max(smoothness_, smoothness);
}

bool ExpressionSeries::is_constant(std::size_t n) const {
  return arb_poly_length(values_[n].get()) <= 1;
}

void ExpressionSeries::run_number(std::size_t n, std::span<const ArbSeries> slots, slong length) {
  const Program::Node& node = program_->nodes[n];
  if (node.op == Operator::constant) return;
  if (node.op == Operator::variable) {
    arb_poly_set_trunc(values_[n].get(), slots[node.a].get(), length);
  } else if (node.op == Operator::if_else) {
    run_if(n, length);
  } else if (is_unary_function(node.op)) {
    run_unary(n, length);
  } else {
    run_binary(n, length);
  }
}

void ExpressionSeries::run_binary(std::size_t n, slong length) {
  const Program::Node& node = program_->nodes[n];
  arb_poly_struct* result = values_[n].get();
  const arb_poly_struct* a = values_[node.a].get();
  const arb_poly_struct* b = values_[node.b].get();
  switch (node.op) {
    case Operator::add:
      return arb_poly_add_series(result, a, b, length, kArbBits);
    case Operator::subtract:
      return arb_poly_sub_series(result, a, b, length, kArbBits);
    case Operator::multiply:
      arb_poly_mullow(result, a, b, length, kArbBits);
      if (node.a == node.b && is_wide(values_[node.a][0])) {
        const Arb whole = absolute(values_[node.a][0]);
        values_[n].set(0, hull(whole.lower() * whole.lower(), whole.upper() * whole.upper()));
      }
      return;
    case Operator::divide:
      return arb_poly_div_series(result, a, b, length, kArbBits);
    case Operator::power:
      return run_power(n, length);
    default:
      return run_choice(n, node.op == Operator::minimum, length);
  }
}

/// a^n for whole n by multiplication, which also works where a may be 0.
void ExpressionSeries::run_power(std::size_t n, slong length) {
  const Program::Node& node = program_->nodes[n];
  const ArbSeries& a = values_[node.a];
  ArbSeries& result = values_[n];
  const Arb exponent = values_[node.b][0];
  if (!is_constant(node.b) || !exponent.is_point())
    return arb_poly_pow_series(result.get(), a.get(), values_[node.b].get(), length, kArbBits);
  const auto whole = static_cast<slong>(exponent.approximately());
  if (arb_is_int(exponent.get()) == 0 || whole > kMostPower || whole < -kMostPower) {
    arb_poly_pow_arb_series(result.get(), a.get(), exponent.get(), length, kArbBits);
    const bool from_zero = arb_is_positive(exponent.get()) != 0 && is_nonnegative_before_rounding(a[0]);
    if (from_zero && length == 1) result.assign(positive_power(a[0], exponent));
    return;
  }
  const auto times = static_cast<ulong>(whole < 0 ? -whole : whole);
  arb_poly_pow_ui_trunc_binexp(result.get(), a.get(), times, length, kArbBits);
  if (times % 2 == 0 && times > 0 && is_wide(constant_term(a))) {
    const Arb size = absolute(constant_term(a));
    Arb least, most;
    arb_pow_ui(least.get(), size.lower().get(), times, kArbBits);
    arb_pow_ui(most.get(), size.upper().get(), times, kArbBits);
    result.set(0, hull(least, most));
  }
  if (whole < 0) {
    const ArbSeries power = result;
    arb_poly_inv_series(result.get(), power.get(), length, kArbBits);
  }
}

void ExpressionSeries::run_unary(std::size_t n, slong length) {
  const Program::Node& node = program_->nodes[n];
  arb_poly_struct* result = values_[n].get();
  const arb_poly_struct* a = values_[node.a].get();
  ArbSeries other;
  switch (node.op) {
    case Operator::negate:
      return arb_poly_neg(result, a);
    case Operator::sine:
      return arb_poly_sin_cos_series(result, other.get(), a, length, kArbBits);
    case Operator::cosine:
      return arb_poly_sin_cos_series(other.get(), result, a, length, kArbBits);
    case Operator::tangent:
      return arb_poly_tan_series(result, a, length, kArbBits);
    case Operator::arcsine:
      return arb_poly_asin_series(result, a, length, kArbBits);
    case Operator::arccosine:
      return arb_poly_acos_series(result, a, length, kArbBits);
    case Operator::arctangent:
      return arb_poly_atan_series(result, a, length, kArbBits);
    case Operator::hyperbolic_sine:
      return arb_poly_sinh_series(result, a, length, kArbBits);
    case Operator::hyperbolic_cosine:
      return arb_poly_cosh_series(result, a, length, kArbBits);
    case Operator::hyperbolic_tangent: {
      ArbSeries cosine;
      arb_poly_sinh_cosh_series(other.get(), cosine.get(), a, length, kArbBits);
      arb_poly_div_series(result, other.get(), cosine.get(), length, kArbBits);
      Arb value;
      arb_tanh(value.get(), constant_term(values_[node.a]).get(), kArbBits);
      return values_[n].set(0, value);
    }
    case Operator::exponential:
      return arb_poly_exp_series(result, a, length, kArbBits);
    case Operator::logarithm:
      return arb_poly_log_series(result, a, length, kArbBits);
    case Operator::square_root: {
      arb_poly_sqrt_series(result, a, length, kArbBits);
      Arb root;
      arb_sqrtpos(root.get(), constant_term(values_[node.a]).get(), kArbBits);
      if (length == 1 && is_nonnegative_before_rounding(constant_term(values_[node.a])))
        values_[n].assign(root);
      return;
    }
    case Operator::absolute:
      return run_absolute(n, length);
    default:
      return run_sign(n);
  }
}

void ExpressionSeries::run_absolute(std::size_t n, slong length) {
  const ArbSeries& a = values_[program_->nodes[n].a];
  const Arb value = constant_term(a);
  ArbSeries& result = values_[n];
  if (arb_is_negative(value.get()) != 0) return arb_poly_neg(result.get(), a.get());
  result = a;
  if (arb_is_positive(value.get()) != 0 || is_constant(program_->nodes[n].a)) {
    result.set(0, absolute(value));
    return;
  }
  lose(Smoothness::lipschitz);
  result.set(0, absolute(value));
  for (slong k = 1; k < length; ++k) result.set(k, unit_range(true) * a[k]);
}

void ExpressionSeries::run_sign(std::size_t n) {
  const Arb value = constant_term(values_[program_->nodes[n].a]);
  Arb sign;
  arb_sgn(sign.get(), value.get());
  if (!sign.is_point()) {
    if (value.is_finite())
      sign = hull(Arb(value.is_nonnegative() ? 0.0 : -1.0), Arb(value.is_nonpositive() ? 0.0 : 1.0));
    lose(Smoothness::jumps);
  } else if (sign.is_zero()) {
    lose(Smoothness::jumps);  // only here
  }
  if (!value.is_finite()) sign = value;
  values_[n].assign(sign);
}

/// min and max: one of their operands where that is certain, else both with weights that sum up to 1.
void ExpressionSeries::run_choice(std::size_t n, bool minimum, slong length) {
  const Program::Node& node = program_->nodes[n];
  const ArbSeries& a = values_[node.a];
  const ArbSeries& b = values_[node.b];
  ArbSeries& result = values_[n];
  const Arb first = constant_term(a), second = constant_term(b);
  if (arb_lt(first.get(), second.get()) != 0 || arb_gt(first.get(), second.get()) != 0) {
    const bool a_counts = (arb_lt(first.get(), second.get()) != 0) == minimum;
    result = a_counts ? a : b;
    return;
  }
  Arb value;
  (minimum ? arb_min : arb_max)(value.get(), first.get(), second.get(), kArbBits);
  if (!is_constant(node.a) || !is_constant(node.b)) lose(Smoothness::lipschitz);
  ArbSeries both;
  both.set(0, value);
  for (slong k = 1; k < length; ++k) both.set(k, hull(a[k], b[k]));
  result = both;
}

void ExpressionSeries::run_if(std::size_t n, slong length) {
  const Program::Node& node = program_->nodes[n];
  const ArbSeries& yes = values_[node.b];
  const ArbSeries& no = values_[node.c];
  if (truths_[node.a] != Truth::undecided) {
    values_[n] = truths_[node.a] == Truth::yes ? yes : no;
    return;
  }
  lose(Smoothness::jumps);
  ArbSeries both;
  for (slong k = 0; k < length; ++k) both.set(k, hull(yes[k], no[k]));
  values_[n] = both;
}

Truth ExpressionSeries::condition(std::size_t n) const {
  const Program::Node& node = program_->nodes[n];
  switch (node.op) {
    case Operator::logical_and:
      return truth_and(truths_[node.a], truths_[node.b]);
    case Operator::logical_or:
      return truth_or(truths_[node.a], truths_[node.b]);
    case Operator::logical_not:
      return !truths_[node.a];
    case Operator::literal_true:
    case Operator::literal_false:
      return to_truth(node.op == Operator::literal_true);
    default:
      return compare(node.op, constant_term(values_[node.a]), constant_term(values_[node.b]));
  }
}

}  // namespace coordreq

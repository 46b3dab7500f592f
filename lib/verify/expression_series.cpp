#include "verify/expression_series.hpp"

#include <algorithm>
#include <span>

#include "base/requires.hpp"
#include "expression/truth_of.hpp"

namespace coordreq {
namespace {

constexpr slong kMostPower = 64;
/// Operations in a function without kinks, and in a choice between operands, which compares ends of balls.
constexpr std::size_t kOfFunction = 12;
constexpr std::size_t kOfChoice = 8;

Arb constant_term(const ArbSeries& a) {
  return a[0];
}

/// [0, 1] or [-1, 1].
Arb unit_range(bool both_sides) {
  return hull(Arb(both_sides ? -1.0 : 0.0), Arb(1.0));
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

/// The side of 0 on which a sum or product of numbers on these sides is: -1, 0 or 1; 2 if that is not known.
int side_of_sum(int a, int b) {
  return a == 2 || b == 2 || a * b < 0 ? 2 : std::clamp(a + b, -1, 1);
}
int side_of_product(int a, int b) {
  return a == 2 || b == 2 ? 2 : a * b;
}
int side_of_constant_term(const ArbSeries& a) {
  arb_srcptr const term = arb_poly_get_coeff_ptr(a.get(), 0);
  if (term == nullptr || arb_is_zero(term) != 0) return 0;
  return arb_is_nonnegative(term) != 0 ? 1 : arb_is_nonpositive(term) != 0 ? -1 : 2;
}

using Series = void (*)(ArbSeries& result, const ArbSeries& a, slong length);

/// A function of one number without kinks, from FLINT/Arb.
struct SmoothFunction {
  Operator op;
  Series series;
  bool keeps_side;  ///< of 0, on which its operand is
};

template <void (*f)(arb_poly_struct*, const arb_poly_struct*, slong, slong)>
void of(ArbSeries& result, const ArbSeries& a, slong length) {
  f(result.get(), a.get(), length, kArbBits);
}
void minus(ArbSeries& result, const ArbSeries& a, slong) {
  arb_poly_neg(result.get(), a.get());
}
void sine(ArbSeries& result, const ArbSeries& a, slong length) {
  ArbSeries other;
  arb_poly_sin_cos_series(result.get(), other.get(), a.get(), length, kArbBits);
}
void cosine(ArbSeries& result, const ArbSeries& a, slong length) {
  ArbSeries other;
  arb_poly_sin_cos_series(other.get(), result.get(), a.get(), length, kArbBits);
}
void hyperbolic_tangent(ArbSeries& result, const ArbSeries& a, slong length) {
  Arb value;
  arb_tanh(value.get(), a[0].get(), kArbBits);
  if (length == 1) return result.assign(value);
  ArbSeries sine, cosine;
  arb_poly_sinh_cosh_series(sine.get(), cosine.get(), a.get(), length, kArbBits);
  arb_poly_div_series(result.get(), sine.get(), cosine.get(), length, kArbBits);
  result.set(0, value);
}
void square_root(ArbSeries& result, const ArbSeries& a, slong length) {
  arb_poly_sqrt_series(result.get(), a.get(), length, kArbBits);
  if (length > 1 || !is_nonnegative_before_rounding(a[0])) return;
  Arb root;
  arb_sqrtpos(root.get(), a[0].get(), kArbBits);
  result.assign(root);
}

constexpr SmoothFunction kSmooth[] = {
    {Operator::negate, minus, false},
    {Operator::sine, sine, false},
    {Operator::cosine, cosine, false},
    {Operator::tangent, of<arb_poly_tan_series>, false},
    {Operator::arcsine, of<arb_poly_asin_series>, true},
    {Operator::arccosine, of<arb_poly_acos_series>, false},
    {Operator::arctangent, of<arb_poly_atan_series>, true},
    {Operator::hyperbolic_sine, of<arb_poly_sinh_series>, true},
    {Operator::hyperbolic_cosine, of<arb_poly_cosh_series>, false},
    {Operator::hyperbolic_tangent, hyperbolic_tangent, true},
    {Operator::exponential, of<arb_poly_exp_series>, false},
    {Operator::logarithm, of<arb_poly_log_series>, false},
    {Operator::square_root, square_root, true},
};

constexpr std::size_t number_of(Operator op) {
  return static_cast<std::size_t>(op);
}
constexpr bool is_in_order(std::span<const SmoothFunction> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (number_of(rows[i].op) != number_of(Operator::negate) + i) return false;
  }
  return true;
}
// A new function needs a row, or a kink in run_unary().
static_assert(is_in_order(kSmooth) &&
              number_of(Operator::absolute) == number_of(Operator::negate) + std::size(kSmooth));
static_assert(number_of(Operator::modulo) == number_of(Operator::absolute) + 3,
              "a function of one number is missing");
static_assert(number_of(Operator::negate) == number_of(Operator::add) + 8,
              "one of two numbers is missing in run_binary()");

/// What is done at one node.
std::size_t operations_in(Operator op) {
  if (op >= Operator::negate && op < Operator::absolute) return op == Operator::negate ? 1 : kOfFunction;
  const bool chooses = op == Operator::minimum || op == Operator::maximum || op == Operator::absolute ||
                       op == Operator::sign || op == Operator::floor || is_comparison(op);
  return chooses ? kOfChoice : 1;
}

const SmoothFunction& smooth_function(Operator op) {
  return kSmooth[number_of(op) - number_of(Operator::negate)];
}

}  // namespace

ExpressionSeries::ExpressionSeries(const Program& program)
    : program_(&program), values_(program.nodes.size()), truths_(program.nodes.size()) {
  REQUIRES(!program.is_condition());
  for (std::size_t n = 0; n < program.nodes.size(); ++n) {
    const Program::Node& node = program.nodes[n];
    if (node.op == Operator::constant) values_[n].assign(Arb(program.constants[node.a]));
    const std::size_t operations = operations_in(node.op);
    operations_ += operations;
    if (!is_condition(node.op) && !is_extended(n)) repeated_ += operations;
  }
}

const ArbSeries& ExpressionSeries::operator()(std::span<const ArbSeries> slots, slong length) {
  smoothness_ = Smoothness::analytic;
  for (std::size_t n = 0; n < values_.size(); ++n) {
    if (is_condition(program_->nodes[n].op)) {
      const Program::Node& node = program_->nodes[n];
      truths_[n] = truth_of(node, truths_, [&] {
        return compare(node.op, constant_term(values_[node.a]), constant_term(values_[node.b]));
      });
    } else {
      run_number(n, slots, length);
    }
  }
  return values_.back();
}

void ExpressionSeries::lose(Smoothness smoothness) {
  smoothness_ = std::max(smoothness_, smoothness);
}

/// Whether two nodes are the same number, for all that can be seen.
bool ExpressionSeries::is_same(std::size_t a, std::size_t b) const {
  const Program::Node& one = program_->nodes[a];
  const Program::Node& other = program_->nodes[b];
  return a == b || (one.op == Operator::variable && other.op == Operator::variable && one.a == other.a);
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
    keep_side(n);
  } else {
    run_binary(n, length);
    keep_side(n);
  }
}

/// A range that ends at 0 matters: a state does not pass where its derivative is 0.
void ExpressionSeries::keep_side(std::size_t n) {
  if (side_of_constant_term(values_[n]) != 2) return;
  const Program::Node& node = program_->nodes[n];
  const int a = side_of_constant_term(values_[node.a]);
  const int b = is_unary_function(node.op) ? 0 : side_of_constant_term(values_[node.b]);
  int side = 2;
  if (node.op == Operator::add) side = side_of_sum(a, b);
  if (node.op == Operator::subtract) side = side_of_sum(a, b == 2 ? 2 : -b);
  if (node.op == Operator::multiply) side = is_same(node.a, node.b) ? 1 : side_of_product(a, b);
  if (node.op == Operator::divide) side = side_of_product(a, b);
  if (node.op < Operator::absolute && is_unary_function(node.op) && smooth_function(node.op).keeps_side)
    side = a;
  if (side == 1 || side == -1) values_[n].set(0, ending_at_zero(constant_term(values_[n]), side == 1));
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
      if (is_same(node.a, node.b) && is_wide(values_[node.a][0])) {
        values_[n].set(0, squared(values_[node.a][0]));
      }
      return;
    case Operator::divide:
      return arb_poly_div_series(result, a, b, length, kArbBits);
    case Operator::power:
      return run_power(n, length);
    case Operator::angle:
      if (angle_series(values_[n], values_[node.a], values_[node.b], length)) lose(Smoothness::jumps);
      return;
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
  if (times == 2) {
    arb_poly_mullow(result.get(), a.get(), a.get(), length, kArbBits);
  } else {
    arb_poly_pow_ui_trunc_binexp(result.get(), a.get(), times, length, kArbBits);
  }
  const bool is_even = times % 2 == 0 && times > 0;
  if (is_even && is_wide(constant_term(a)) && times == 2) {
    result.set(0, squared(constant_term(a)));
  } else if (is_even && is_wide(constant_term(a))) {
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
  if (node.op == Operator::absolute) return run_absolute(n, length);
  if (node.op == Operator::sign) return run_sign(n);
  if (node.op == Operator::floor) return run_floor(n);
  smooth_function(node.op).series(values_[n], values_[node.a], length);
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

void ExpressionSeries::run_floor(std::size_t n) {
  const Arb value = constant_term(values_[program_->nodes[n].a]);
  if (!value.is_finite()) return values_[n].assign(value);
  Arb least, most;
  arb_floor(least.get(), value.lower().get(), kArbBits);
  arb_floor(most.get(), value.upper().get(), kArbBits);
  if (arb_equal(least.get(), most.get()) == 0 || (value.is_point() && arb_is_int(value.get()) != 0))
    lose(Smoothness::jumps);
  values_[n].assign(hull(least, most));
}

/// min and max: one of their operands where that is certain, else both with weights that sum up to 1.
void ExpressionSeries::run_choice(std::size_t n, bool minimum, slong length) {
  const Program::Node& node = program_->nodes[n];
  const ArbSeries& a = values_[node.a];
  const ArbSeries& b = values_[node.b];
  ArbSeries& result = values_[n];
  if (is_same(node.a, node.b)) {
    result = a;
    return;
  }
  const Arb first = constant_term(a), second = constant_term(b);
  const bool is_less = arb_lt(first.get(), second.get()) != 0;
  if (is_less || arb_gt(first.get(), second.get()) != 0) {
    result = is_less == minimum ? a : b;
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

}  // namespace coordreq

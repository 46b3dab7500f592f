#include "verify/time_polynomial.hpp"

#include <acb.h>
#include <arb_fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>

#include <algorithm>
#include <vector>

#include "verify/arb.hpp"

namespace coordreq {
namespace {

constexpr slong kRootBits = 192;

/// A real root: a point, or a ball that holds it alone.
struct Root {
  Arb ball;
  Rational lower;
  Rational upper;
  [[nodiscard]] bool is_known() const { return lower == upper; }
};

void add_linear_root(const fmpz_poly_struct* factor, std::vector<Root>& roots) {
  FlintRational root;
  fmpq_set_fmpz_frac(root.get(), fmpz_poly_get_coeff_ptr(factor, 0), fmpz_poly_get_coeff_ptr(factor, 1));
  fmpq_neg(root.get(), root.get());
  roots.push_back({Arb(root.value()), root.value(), root.value()});
}

void add_roots(const fmpz_poly_struct* factor, std::vector<Root>& roots) {
  const slong degree = fmpz_poly_degree(factor);
  if (degree == 1 && !fmpz_is_zero(fmpz_poly_get_coeff_ptr(factor, 0))) return add_linear_root(factor, roots);
  if (degree == 1) {
    roots.push_back({Arb(), 0, 0});
    return;
  }
  acb_ptr all = _acb_vec_init(degree);
  arb_fmpz_poly_complex_roots(all, factor, 0, kRootBits);
  for (slong i = 0; i < degree; ++i) {
    if (acb_is_real(all + i) == 0) continue;
    Arb ball;
    arb_set(ball.get(), acb_realref(all + i));
    roots.push_back({ball, ball.lower_rational(), ball.upper_rational()});
  }
  _acb_vec_clear(all, degree);
}

/// The real roots that may be in [0, end], ascending, each once.
std::vector<Root> roots_on(const TimePolynomial& p, const Rational& end) {
  std::vector<Root> roots;
  if (fmpq_poly_degree(p.get()) < 1) return roots;
  fmpz_poly_t numerator;
  fmpz_poly_init(numerator);
  fmpq_poly_get_numerator(numerator, p.get());
  fmpz_poly_factor_t factors;
  fmpz_poly_factor_init(factors);
  fmpz_poly_factor(factors, numerator);
  for (slong i = 0; i < factors->num; ++i) add_roots(factors->p + i, roots);
  fmpz_poly_factor_clear(factors);
  fmpz_poly_clear(numerator);
  std::erase_if(roots, [&end](const Root& root) { return root.upper < 0 || root.lower > end; });
  std::sort(roots.begin(), roots.end(), [](const Root& a, const Root& b) { return a.lower < b.lower; });
  return roots;
}

Arb value_at(const TimePolynomial& p, const Arb& t) {
  ArbSeries series;
  arb_poly_set_fmpq_poly(series.get(), p.get(), kRootBits);
  Arb value;
  arb_poly_evaluate(value.get(), series.get(), t.get(), kRootBits);
  return value;
}

std::int64_t floor_of(const Arb& ball, bool lower) {
  arf_t end;
  arf_init(end);
  (lower ? arb_get_lbound_arf : arb_get_ubound_arf)(end, ball.get(), kRootBits);
  arf_floor(end, end);
  FlintRational floor;
  arf_get_fmpq(floor.get(), end);
  arf_clear(end);
  return floor_to_int(floor.value());
}

bool is_dyadic(const Rational& point) {
  constexpr unsigned long kFinest = 1UL << 20U;
  return point.get_den() <= kFinest && is_integer(point * Rational(kFinest));
}

}  // namespace

TimePolynomial::TimePolynomial(std::initializer_list<Rational> coefficients) : TimePolynomial() {
  slong k = 0;
  for (const Rational& coefficient : coefficients) set(k++, coefficient);
}

Rational TimePolynomial::operator[](slong k) const {
  FlintRational coefficient;
  fmpq_poly_get_coeff_fmpq(coefficient.get(), p_, k);
  return coefficient.value();
}

void TimePolynomial::set(slong k, const Rational& coefficient) {
  fmpq_poly_set_coeff_fmpq(p_, k, FlintRational(coefficient).get());
}

Rational TimePolynomial::at(const Rational& t) const {
  FlintRational value;
  fmpq_poly_evaluate_fmpq(value.get(), p_, FlintRational(t).get());
  return value.value();
}

TimePolynomial TimePolynomial::derivative() const {
  TimePolynomial result;
  fmpq_poly_derivative(result.p_, p_);
  return result;
}

TimePolynomial TimePolynomial::integral() const {
  TimePolynomial result;
  fmpq_poly_integral(result.p_, p_);
  return result;
}

TimePolynomial& TimePolynomial::operator*=(const Rational& factor) {
  fmpq_poly_scalar_mul_fmpq(p_, p_, FlintRational(factor).get());
  return *this;
}

int sign_on(const TimePolynomial& p, const Rational& end) {
  const std::vector<Root> roots = roots_on(p, end);
  bool positive = false;
  bool negative = false;
  Rational from = 0;
  const auto look_until = [&](const Rational& to) {
    if (to <= from) return;
    const int sign = sgn(p.at((from + to) / 2));
    positive = positive || sign > 0;
    negative = negative || sign < 0;
  };
  for (const Root& root : roots) {
    if (!root.is_known() && (root.lower <= 0 || root.upper >= end)) return 0;
    look_until(root.lower);
    from = root.upper;
  }
  look_until(end);
  if (positive && negative) return 0;
  return negative ? -1 : 1;
}

FloorOfLeast floor_of_least(const TimePolynomial& p, const Rational& end) {
  FloorOfLeast result;
  result.inner = std::min(floor_to_int(p.at(0)), floor_to_int(p.at(end)));
  result.outer = result.inner;
  for (const Root& root : roots_on(p.derivative(), end)) {
    const Arb value = root.is_known() ? Arb() : value_at(p, root.ball);
    const std::int64_t low = root.is_known() ? floor_to_int(p.at(root.lower)) : floor_of(value, true);
    const std::int64_t high = root.is_known() ? low : floor_of(value, false);
    result.outer = std::min(result.outer, low);
    if (root.lower >= 0 && root.upper <= end) result.inner = std::min(result.inner, high);
  }
  return result;
}

SwitchingIntegral integrate_switching(const TimePolynomial& p, const Rational& end) {
  const TimePolynomial whole = p.integral();
  if (sign_on(p, end) != 0) return {.value = abs(whole.at(end)), .exact = true};
  SwitchingIntegral result{.value = 0};
  Arb rest;
  Root from{Arb(), 0, 0};
  const auto add_until = [&](const Root& to) {
    if (from.is_known() && to.is_known()) {
      result.value += abs(whole.at(to.lower) - whole.at(from.lower));
    } else {
      const Arb change = value_at(whole, to.ball) - value_at(whole, from.ball);
      Arb size;
      arb_abs(size.get(), change.get());
      rest = rest + size;
    }
    from = to;
  };
  for (const Root& root : roots_on(p, end)) {
    add_until(root);
    result.exact = result.exact && root.is_known() && is_dyadic(root.lower / end);
  }
  add_until({Arb(end), end, end});
  if (!rest.is_zero()) result.value += rest.upper_rational();
  return result;
}

}  // namespace coordreq

#include "verify/multinomial.hpp"

#include <algorithm>
#include <utility>

#include "expression/domains.hpp"

namespace coordreq {
namespace {

// What is larger is not worth multiplying out.
constexpr std::size_t kMostTerms = 2000;
constexpr long kMostFactors = 32;

RationalInterval point_of(const Rational& q) {
  return {.lower = q, .upper = q};
}

Multinomial unknown() {
  Multinomial result;
  result.known = false;
  return result;
}

Multinomial constant_of(RationalInterval value) {
  Multinomial result;
  result.constant = std::move(value);
  return result;
}

void add_to(Multinomial& sum, const Multinomial::Product& product, const Rational& coefficient) {
  const auto place = sum.terms.try_emplace(product, 0).first;
  place->second += coefficient;
  if (place->second == 0) sum.terms.erase(place);
}

Multinomial times_constant(const Multinomial& a, const RationalInterval& factor) {
  if (!a.terms.empty() && !factor.is_point()) return unknown();
  Multinomial result = constant_of(a.constant * factor);
  for (const auto& [product, coefficient] : a.terms) add_to(result, product, coefficient * factor.lower);
  return result;
}

Multinomial sum_of(const Multinomial& a, const Multinomial& b) {
  Multinomial result = a;
  result.constant = a.constant + b.constant;
  for (const auto& [product, coefficient] : b.terms) add_to(result, product, coefficient);
  return result;
}

Multinomial product_of(const Multinomial& a, const Multinomial& b) {
  if (a.terms.empty()) return times_constant(b, a.constant);
  if (b.terms.empty()) return times_constant(a, b.constant);
  if (!a.constant.is_point() || !b.constant.is_point()) return unknown();
  Multinomial result = sum_of(times_constant(a, b.constant), times_constant(b, a.constant));
  result.constant = a.constant * b.constant;
  for (const auto& [left, p] : a.terms) {
    for (const auto& [right, q] : b.terms) {
      Multinomial::Product product;
      std::merge(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(product));
      if (product.size() > static_cast<std::size_t>(kMostFactors)) return unknown();
      add_to(result, product, p * q);
    }
  }
  return result.terms.size() <= kMostTerms ? result : unknown();
}

Multinomial power_of(const Multinomial& base, const Multinomial& exponent) {
  if (base.terms.empty() && exponent.terms.empty()) {
    return constant_of(apply(Operator::power, base.constant, exponent.constant));
  }
  if (!exponent.terms.empty() || !exponent.constant.is_point()) return unknown();
  const Rational& n = exponent.constant.lower;
  if (!is_integer(n) || n < 0 || n > kMostFactors) return unknown();
  Multinomial result = Multinomial::point(1);
  for (long k = 0; k < n && result.known; ++k) result = product_of(result, base);
  return result;
}

Multinomial quotient_of(const Multinomial& a, const Multinomial& b) {
  if (!b.terms.empty()) return unknown();
  if (a.terms.empty()) return constant_of(a.constant / b.constant);
  return times_constant(a, point_of(1) / b.constant);
}

bool same(const Multinomial& a, const Multinomial& b) {
  return a.terms == b.terms && a.constant.is_point() && b.constant.is_point() &&
         a.constant.lower == b.constant.lower;
}

}  // namespace

Multinomial Multinomial::variable(std::uint32_t slot) {
  Multinomial result = point(0);
  result.terms.emplace(Product{slot}, 1);
  return result;
}

Multinomial Multinomial::point(const Rational& value) {
  return constant_of(point_of(value));
}

Rational Multinomial::slope(std::uint32_t slot) const {
  const auto found = terms.find(Product{slot});
  return found == terms.end() ? Rational(0) : found->second;
}

bool Multinomial::is_affine() const {
  return known &&
         std::all_of(terms.begin(), terms.end(), [](const auto& term) { return term.first.size() == 1; });
}

Multinomial from_rational(const Multinomial*, const Rational& q) {
  return Multinomial::point(q);
}

Multinomial apply(Operator op, const Multinomial& a) {
  if (!a.known) return a;
  if (op == Operator::negate) return times_constant(a, point_of(-1));
  return a.terms.empty() ? constant_of(apply(op, a.constant)) : unknown();
}

Multinomial apply(Operator op, const Multinomial& a, const Multinomial& b) {
  if (!a.known || !b.known) return unknown();
  switch (op) {
    case Operator::add:
      return sum_of(a, b);
    case Operator::subtract:
      return sum_of(a, times_constant(b, point_of(-1)));
    case Operator::multiply:
      return product_of(a, b);
    case Operator::divide:
      return quotient_of(a, b);
    case Operator::power:
      return power_of(a, b);
    default:
      return a.terms.empty() && b.terms.empty() ? constant_of(apply(op, a.constant, b.constant)) : unknown();
  }
}

Truth compare(Operator op, const Multinomial& a, const Multinomial& b) {
  if (!a.known || !b.known) return Truth::undecided;
  if (a.terms == b.terms) return compare(op, a.constant, b.constant);
  return Truth::undecided;
}

Multinomial select(Truth condition, const Multinomial& a, const Multinomial& b) {
  if (condition == Truth::yes) return a;
  if (condition == Truth::no) return b;
  return a.known && b.known && same(a, b) ? a : unknown();
}

}  // namespace coordreq

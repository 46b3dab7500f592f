#include "reach/polynomial.hpp"

#include <algorithm>

#include "expression/domains.hpp"
#include "expression/exact_equations.hpp"

namespace coordreq {
namespace {

Polynomial::Monomial product(const Polynomial::Monomial& a, const Polynomial::Monomial& b) {
  Polynomial::Monomial result;
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first)) {
      result.push_back(*i++);
    } else if (i == a.end() || j->first < i->first) {
      result.push_back(*j++);
    } else {
      result.emplace_back(i->first, i->second + j->second);
      ++i;
      ++j;
    }
  }
  return result;
}

void add_term(Polynomial& sum, const Polynomial::Monomial& monomial, const Rational& coefficient) {
  Rational& slot = sum.terms[monomial];
  slot += coefficient;
  if (slot == 0) sum.terms.erase(monomial);
}

Polynomial add(Polynomial a, const Polynomial& b) {
  for (const auto& [monomial, coefficient] : b.terms) add_term(a, monomial, coefficient);
  a.constant = apply(Operator::add, a.constant, b.constant);
  return a;
}

Polynomial scale(const Polynomial& a, const RationalInterval& factor) {
  Polynomial result;
  result.constant = apply(Operator::multiply, a.constant, factor);
  if (a.terms.empty()) return result;
  if (!factor.is_point()) return Polynomial::unknown();
  if (factor.lower == 0) return result;
  for (const auto& [monomial, coefficient] : a.terms) result.terms[monomial] = coefficient * factor.lower;
  return result;
}

Polynomial multiply(const Polynomial& a, const Polynomial& b) {
  if (a.is_constant()) return scale(b, a.constant);
  if (b.is_constant()) return scale(a, b.constant);
  if (!a.constant.is_point() || !b.constant.is_point()) return Polynomial::unknown();
  if (a.degree() + b.degree() > kMostDegreeOfExact || a.terms.size() * b.terms.size() > kMostTermsOfExact)
    return Polynomial::unknown();
  Polynomial result;
  result.constant = apply(Operator::multiply, a.constant, b.constant);
  for (const auto& [monomial, coefficient] : a.terms) {
    for (const auto& [other, factor] : b.terms)
      add_term(result, product(monomial, other), coefficient * factor);
    if (b.constant.lower != 0) add_term(result, monomial, coefficient * b.constant.lower);
  }
  if (a.constant.lower != 0) {
    for (const auto& [other, factor] : b.terms) add_term(result, other, factor * a.constant.lower);
  }
  return result;
}

Polynomial power(const Polynomial& base, const Polynomial& exponent) {
  if (!exponent.is_constant() || !exponent.constant.is_point()) return Polynomial::unknown();
  const Rational& n = exponent.constant.lower;
  if (!is_integer(n) || n < 0 || n > kMostDegreeOfExact) return Polynomial::unknown();
  Polynomial result = Polynomial::value(1);
  for (std::int64_t i = floor_to_int(n); i > 0 && result.known; --i) result = multiply(result, base);
  return result;
}

Polynomial of_constant(RationalInterval value) {
  Polynomial result;
  result.constant = std::move(value);
  return result;
}

Polynomial minus(const Polynomial& a) {
  return scale(a, from_rational(static_cast<const RationalInterval*>(nullptr), Rational(-1)));
}

}  // namespace

std::uint32_t Polynomial::degree() const {
  std::uint32_t largest = 0;
  for (const auto& term : terms) {
    std::uint32_t sum = 0;
    for (const auto& factor : term.first) sum += factor.second;
    largest = std::max(largest, sum);
  }
  return largest;
}

Polynomial Polynomial::variable(std::uint32_t slot) {
  Polynomial result = value(0);
  result.terms[{{slot, 1}}] = 1;
  return result;
}

Polynomial Polynomial::value(const Rational& q) {
  return of_constant(from_rational(static_cast<const RationalInterval*>(nullptr), q));
}

Polynomial Polynomial::unknown() {
  Polynomial result;
  result.known = false;
  return result;
}

Polynomial from_rational(const Polynomial*, const Rational& q) {
  return Polynomial::value(q);
}

Polynomial apply(Operator op, const Polynomial& a) {
  if (!a.known) return a;
  if (op == Operator::negate) return minus(a);
  return a.is_constant() ? of_constant(apply(op, a.constant)) : Polynomial::unknown();
}

Polynomial apply(Operator op, const Polynomial& a, const Polynomial& b) {
  if (!a.known || !b.known) return Polynomial::unknown();
  if (a.is_constant() && b.is_constant()) return of_constant(apply(op, a.constant, b.constant));
  switch (op) {
    case Operator::add:
      return add(a, b);
    case Operator::subtract:
      return add(a, minus(b));
    case Operator::multiply:
      return multiply(a, b);
    case Operator::divide: {
      if (!b.is_constant()) return Polynomial::unknown();
      const Polynomial one = Polynomial::value(1);
      return scale(a, apply(Operator::divide, one.constant, b.constant));
    }
    case Operator::power:
      return power(a, b);
    default:
      return Polynomial::unknown();
  }
}

Truth compare(Operator op, const Polynomial& a, const Polynomial& b) {
  if (!a.known || !b.known) return Truth::undecided;
  if (a.is_constant() && b.is_constant()) return compare(op, a.constant, b.constant);
  const Polynomial difference = add(a, minus(b));
  if (!difference.is_constant()) return Truth::undecided;
  return compare(op, difference.constant, Polynomial::value(0).constant);
}

Polynomial select(Truth condition, const Polynomial& a, const Polynomial& b) {
  if (condition == Truth::undecided) return Polynomial::unknown();
  return condition == Truth::yes ? a : b;
}

}  // namespace coordreq

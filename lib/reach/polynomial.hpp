#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "expression/operators.hpp"
#include "numeric/rational_interval.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// A polynomial in the variables of an expression with exact rational coefficients, as an evaluation domain:
/// running a program over it multiplies everything out, so that the degree of `x*(1 + y) - x*y` is seen to
/// be 1.
///
/// The constant term is an interval, because functions of fixed inputs may be irrational (cos(u)). Anything
/// that is no such polynomial (sin(x), a branch that depends on x, an irrational factor of x, more than a
/// bounded number of terms) is `known == false`.
struct Polynomial {
  /// Slots with exponents, ascending by slot, exponents >= 1; never empty as a key of `terms`.
  using Monomial = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  bool known = true;
  std::map<Monomial, Rational> terms;  ///< no zero coefficients
  RationalInterval constant;

  [[nodiscard]] bool is_constant() const { return known && terms.empty(); }
  /// Largest sum of exponents of a term; 0 for a constant.
  [[nodiscard]] std::uint32_t degree() const;

  [[nodiscard]] static Polynomial variable(std::uint32_t slot);
  [[nodiscard]] static Polynomial value(const Rational& q);
  [[nodiscard]] static Polynomial unknown();
};

// The operations that Evaluator<Polynomial> needs.
[[nodiscard]] Polynomial from_rational(const Polynomial* tag, const Rational& q);
[[nodiscard]] Polynomial apply(Operator op, const Polynomial& a);
[[nodiscard]] Polynomial apply(Operator op, const Polynomial& a, const Polynomial& b);
[[nodiscard]] Truth compare(Operator op, const Polynomial& a, const Polynomial& b);
[[nodiscard]] Polynomial select(Truth condition, const Polynomial& a, const Polynomial& b);

}  // namespace coordreq

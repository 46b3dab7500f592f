#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "expression/operators.hpp"
#include "numeric/rational_interval.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// A number type for Evaluator that multiplies equations out: a sum of rational multiples of products of
/// variables, and a constant that is perhaps only enclosed. With it the verifier finds out by itself which
/// systems are exact (contract, "Cells").
struct Multinomial {
  /// Slots in ascending order, one for each factor; x^2 y is {x, x, y}. Never empty.
  using Product = std::vector<std::uint32_t>;

  bool known = true;  ///< false: no such sum, as for sin(x)
  RationalInterval constant;
  std::map<Product, Rational> terms;  ///< no coefficient is 0

  [[nodiscard]] static Multinomial variable(std::uint32_t slot);
  [[nodiscard]] static Multinomial point(const Rational& value);

  /// The coefficient of one variable by itself.
  [[nodiscard]] Rational slope(std::uint32_t slot) const;
  /// No product of two variables is left.
  [[nodiscard]] bool is_affine() const;
};

[[nodiscard]] Multinomial from_rational(const Multinomial* tag, const Rational& q);
[[nodiscard]] Multinomial apply(Operator op, const Multinomial& a);
[[nodiscard]] Multinomial apply(Operator op, const Multinomial& a, const Multinomial& b);
[[nodiscard]] Truth compare(Operator op, const Multinomial& a, const Multinomial& b);
[[nodiscard]] Multinomial select(Truth condition, const Multinomial& a, const Multinomial& b);

}  // namespace coordreq

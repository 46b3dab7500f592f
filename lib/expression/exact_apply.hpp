#pragma once

#include <optional>

#include "expression/operators.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// op(a) and op(a, b) where they are defined, rational, and seen to be so: the rational operations within the
/// limits of numeric/rational_functions.hpp, roots that come out even, and values such as exp(0) = 1.
/// @returns nothing otherwise, so "nothing" means undefined, irrational or too large
[[nodiscard]] std::optional<Rational> exact_apply(Operator op, const Rational& a);
[[nodiscard]] std::optional<Rational> exact_apply(Operator op, const Rational& a, const Rational& b);

/// Whether "a op b" holds. REQUIRES: is_comparison(op).
[[nodiscard]] bool exact_compare(Operator op, const Rational& a, const Rational& b);

}  // namespace coordreq

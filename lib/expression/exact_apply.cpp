#include "expression/exact_apply.hpp"

#include "numeric/rational_functions.hpp"

namespace coordreq {
namespace {

std::optional<Rational> value_if(bool condition, int value) {
  return condition ? std::optional<Rational>(value) : std::nullopt;
}

std::optional<Rational> within_limit(const Rational& q) {
  return bit_size(q) <= kMostRationalBits ? std::optional<Rational>(q) : std::nullopt;
}

}  // namespace

std::optional<Rational> exact_apply(Operator op, const Rational& a) {
  switch (op) {
    case Operator::negate:
      return Rational(-a);
    case Operator::absolute:
      return Rational(abs(a));
    case Operator::sign:
      return Rational(sgn(a));
    case Operator::square_root:
      return sgn(a) < 0 ? std::nullopt : exact_root(a, 2);
    case Operator::cosine:
    case Operator::hyperbolic_cosine:
    case Operator::exponential:
      return value_if(sgn(a) == 0, 1);
    case Operator::arccosine:
    case Operator::logarithm:
      return value_if(a == 1, 0);
    case Operator::sine:
    case Operator::tangent:
    case Operator::arcsine:
    case Operator::arctangent:
    case Operator::hyperbolic_sine:
    case Operator::hyperbolic_tangent:
      return value_if(sgn(a) == 0, 0);
    default:
      return std::nullopt;
  }
}

std::optional<Rational> exact_apply(Operator op, const Rational& a, const Rational& b) {
  switch (op) {
    case Operator::add:
      return within_limit(a + b);
    case Operator::subtract:
      return within_limit(a - b);
    case Operator::multiply:
      return within_limit(a * b);
    case Operator::divide:
      return sgn(b) == 0 ? std::nullopt : within_limit(a / b);
    case Operator::power:
      return exact_power(a, b);
    case Operator::minimum:
      return a < b ? a : b;
    case Operator::maximum:
      return a < b ? b : a;
    default:
      return std::nullopt;
  }
}

bool exact_compare(Operator op, const Rational& a, const Rational& b) {
  const int order = cmp(a, b);
  switch (op) {
    case Operator::less:
      return order < 0;
    case Operator::less_equal:
      return order <= 0;
    case Operator::greater:
      return order > 0;
    case Operator::greater_equal:
      return order >= 0;
    case Operator::equal:
      return order == 0;
    default:
      return order != 0;
  }
}

}  // namespace coordreq

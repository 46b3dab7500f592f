#include "expression/domains.hpp"

#include <cmath>
#include <limits>

namespace coordreq {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double double_power(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return kUndefined;
  if (b == 2.0) return a * a;
  if (a == 0.0 && b < 0.0) return kUndefined;
  return std::pow(a, b);
}

double double_sign(double a) {
  if (std::isnan(a)) return a;
  return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : 0.0;
}

}  // namespace

double from_rational(const double* /*tag*/, const Rational& q) {
  return nearest_double(q);
}

double apply(Operator op, const double& a) {
  switch (op) {
    case Operator::negate:
      return -a;
    case Operator::sine:
      return std::sin(a);
    case Operator::cosine:
      return std::cos(a);
    case Operator::tangent:
      return std::tan(a);
    case Operator::arcsine:
      return std::asin(a);
    case Operator::arccosine:
      return std::acos(a);
    case Operator::arctangent:
      return std::atan(a);
    case Operator::hyperbolic_sine:
      return std::sinh(a);
    case Operator::hyperbolic_cosine:
      return std::cosh(a);
    case Operator::hyperbolic_tangent:
      return std::tanh(a);
    case Operator::exponential:
      return std::exp(a);
    case Operator::logarithm:
      return a > 0.0 ? std::log(a) : kUndefined;
    case Operator::square_root:
      return std::sqrt(a);
    case Operator::absolute:
      return std::fabs(a);
    case Operator::sign:
      return double_sign(a);
    default:
      return kUndefined;
  }
}

double apply(Operator op, const double& a, const double& b) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return b == 0.0 ? kUndefined : a / b;
    case Operator::power:
      return double_power(a, b);
    case Operator::minimum:
      return std::isnan(b) || b < a ? b : a;
    case Operator::maximum:
      return std::isnan(b) || b > a ? b : a;
    default:
      return kUndefined;
  }
}

Truth compare(Operator op, const double& a, const double& b) {
  return truth_of(op, {a<b, a> b, a <= b, a >= b});
}

double select(Truth condition, const double& a, const double& b) {
  if (condition == Truth::undecided) return kUndefined;
  return condition == Truth::yes ? a : b;
}

Interval from_rational(const Interval* /*tag*/, const Rational& q) {
  return enclose(q);
}

Interval apply(Operator op, const Interval& a) {
  switch (op) {
    case Operator::negate:
      return -a;
    case Operator::sine:
      return sin(a);
    case Operator::cosine:
      return cos(a);
    case Operator::tangent:
      return tan(a);
    case Operator::arcsine:
      return asin(a);
    case Operator::arccosine:
      return acos(a);
    case Operator::arctangent:
      return atan(a);
    case Operator::hyperbolic_sine:
      return sinh(a);
    case Operator::hyperbolic_cosine:
      return cosh(a);
    case Operator::hyperbolic_tangent:
      return tanh(a);
    case Operator::exponential:
      return exp(a);
    case Operator::logarithm:
      return log(a);
    case Operator::square_root:
      return sqrt(a);
    case Operator::absolute:
      return abs(a);
    case Operator::sign:
      return sign(a);
    default:
      return whole_line(false);
  }
}

Interval apply_rare(Operator op, const Interval& a, const Interval& b) {
  switch (op) {
    case Operator::divide:
      return a / b;
    case Operator::minimum:
      return min(a, b);
    case Operator::maximum:
      return max(a, b);
    default:
      return whole_line(false);
  }
}

RationalInterval from_rational(const RationalInterval* /*tag*/, const Rational& q) {
  return {q, q, true, true};
}

RationalInterval apply(Operator op, const RationalInterval& a) {
  switch (op) {
    case Operator::negate:
      return -a;
    case Operator::absolute:
      return abs(a);
    case Operator::sign:
      return sign(a);
    case Operator::square_root:
      return sqrt(a);
    // sin(0), exp(0) and the like stay exact: Interval gives them as points.
    default:
      return to_rational(apply(op, enclose(a)));
  }
}

RationalInterval apply(Operator op, const RationalInterval& a, const RationalInterval& b) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::power:
      return pow(a, b);
    case Operator::minimum:
      return min(a, b);
    case Operator::maximum:
      return max(a, b);
    default:
      return to_rational(whole_line(false));
  }
}

Truth compare(Operator op, const RationalInterval& a, const RationalInterval& b) {
  if (!a.total || !b.total || !a.bounded || !b.bounded) return Truth::undecided;
  return truth_of(op, {a.upper<b.lower, a.lower> b.upper, a.upper <= b.lower, a.lower >= b.upper});
}

RationalInterval select(Truth condition, const RationalInterval& a, const RationalInterval& b) {
  if (condition == Truth::undecided) return hull(a, b);
  return condition == Truth::yes ? a : b;
}

}  // namespace coordreq

#include "expression/domains.hpp"

#include <limits>

namespace coordreq {

double from_rational(const double* /*tag*/, const Rational& q) {
  return nearest_double(q);
}

Truth compare(Operator op, const double& a, const double& b) {
  return truth_of(op, {a<b, a> b, a <= b, a >= b});
}

double select(Truth condition, const double& a, const double& b) {
  if (condition == Truth::undecided) return std::numeric_limits<double>::quiet_NaN();
  return condition == Truth::yes ? a : b;
}

Interval from_rational(const Interval* /*tag*/, const Rational& q) {
  return enclose(q);
}

RationalInterval from_rational(const RationalInterval* /*tag*/, const Rational& q) {
  return {q, q, true, true};
}

Truth compare(Operator op, const RationalInterval& a, const RationalInterval& b) {
  if (!a.total || !b.total || !a.bounded || !b.bounded) return Truth::undecided;
  return truth_of(op, {a.upper<b.lower, a.lower> b.upper, a.upper <= b.lower, a.lower >= b.upper});
}

RationalInterval select(Truth condition, const RationalInterval& a, const RationalInterval& b) {
  if (condition == Truth::undecided) return hull(a, b);
  return condition == Truth::yes ? a : b;
}

Truth compare(Operator op, const Rational& a, const Rational& b) {
  const int order = cmp(a, b);
  return truth_of(op, {order<0, order> 0, order <= 0, order >= 0});
}

}  // namespace coordreq

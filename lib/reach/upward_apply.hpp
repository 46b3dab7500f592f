#pragma once

#include "expression/domains.hpp"
#include "expression/dual.hpp"
#include "numeric/upward_interval.hpp"

// The operations of expressions within rounded_upward(): what apply() gives for the same arguments, or less.
// Arithmetic is UpwardInterval's; all else rounds to nearest meanwhile.
namespace coordreq {

[[nodiscard]] inline Interval apply_upward(Operator op, const Interval& a) {
  if (op == Operator::negate) return -a;
  Interval result;
  rounded_to_nearest([&] { result = apply(op, a); });
  return result;
}

[[nodiscard]] inline Interval apply_upward(Operator op, const Interval& a, const Interval& b) {
  const bool total = a.total && b.total;
  switch (op) {
    case Operator::add:
      return (UpwardInterval(a) + UpwardInterval(b)).interval(total);
    case Operator::subtract:
      return (UpwardInterval(a) - UpwardInterval(b)).interval(total);
    case Operator::multiply:
      return (UpwardInterval(a) * UpwardInterval(b)).interval(total);
    case Operator::divide:
      if (b.contains(0.0)) break;
      return (UpwardInterval(a) / UpwardInterval(b)).interval(total);
    case Operator::power:
      if (b.lower != 2.0 || b.upper != 2.0) break;
      return sqr(UpwardInterval(a)).interval(total);
    default:
      break;
  }
  Interval result;
  rounded_to_nearest([&] { result = apply(op, a, b); });
  return result;
}

[[nodiscard]] inline Dual apply_upward(Operator op, const Dual& a) {
  Dual result;
  rounded_to_nearest([&] { result = apply(op, a); });
  return result;
}

[[nodiscard]] inline Dual apply_upward(Operator op, const Dual& a, const Dual& b) {
  Dual result;
  const auto combine = [&](auto each) {
    result.value = apply_upward(op, a.value, b.value);
    result.total = a.total && b.total && result.value.total;
    result.directions = std::max(a.directions, b.directions);
    for (std::size_t j = 0; j < result.directions; ++j) {
      result.gradient[j] = each(UpwardInterval(a.gradient[j]), UpwardInterval(b.gradient[j])).interval();
    }
    result.jump = each(UpwardInterval(a.jump), UpwardInterval(b.jump)).interval();
  };
  const UpwardInterval by_a(b.value);
  const UpwardInterval by_b(a.value);
  switch (op) {
    case Operator::add:
      combine([](const UpwardInterval& x, const UpwardInterval& y) { return x + y; });
      return result;
    case Operator::subtract:
      combine([](const UpwardInterval& x, const UpwardInterval& y) { return x - y; });
      return result;
    case Operator::multiply:
      combine([&](const UpwardInterval& x, const UpwardInterval& y) { return x * by_a + y * by_b; });
      return result;
    default:
      break;
  }
  rounded_to_nearest([&] { result = apply(op, a, b); });
  return result;
}

}  // namespace coordreq

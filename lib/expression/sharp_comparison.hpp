#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "expression/formula.hpp"

namespace coordreq {

/// Decides g op 0 over a box, g the difference of two numbers in which variables may be repeated.
///
/// Three enclosures of g's range, cheapest first: natural evaluation; the mean-value form
/// g(c) + sum_j G_j * (X_j - c_j) with G_j enclosing dg/dx_j over the box; and natural evaluation, exact in
/// rationals, with each variable in which g is monotone replaced by the end that gives the least (the
/// greatest) value: that is the exact range if g is rational and monotone in all variables that are repeated.
/// Errs towards `undecided`. Scratch inside: one object a thread.
class SharpComparison {
 public:
  /// @pre unchecked: `comparison` outlives this object.
  explicit SharpComparison(const Formula::Comparison& comparison);

  /// @param box by slot. @pre bounded and total in all variables of the comparison
  [[nodiscard]] Truth decide(std::span<const RationalInterval> box);

 private:
  [[nodiscard]] Truth truth(double lower, double upper) const;
  [[nodiscard]] const Dual& derivative(std::span<const RationalInterval> box);
  [[nodiscard]] Truth by_mean_value(const Dual& g);
  [[nodiscard]] Truth by_monotonicity(std::span<const RationalInterval> box, const Dual& g);

  Operator op_;
  std::vector<std::uint32_t> variables_;  ///< the first ones are the directions of the derivative
  std::size_t directions_;
  Evaluator<Dual> dual_;
  Evaluator<Interval> fast_;
  Evaluator<RationalInterval> exact_;
  std::vector<Interval> box_;  ///< by slot, as are the next three
  std::vector<Dual> seeds_;
  std::vector<Interval> centre_;
  std::vector<RationalInterval> ends_;
};

}  // namespace coordreq

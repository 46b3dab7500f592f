#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "expression/formula.hpp"
#include "expression/point_value.hpp"

namespace coordreq {

/// How far a point is from making a condition false, in the units of what is compared: the quantitative
/// semantics of a condition (Fainekos and Pappas 2009, doi 10.1016/j.tcs.2009.06.021).
///
///   a < b, a <= b: b - a     a == b: -|a - b|     p and q: min     true: infinity
///   a > b, a >= b: a - b     a != b: |a - b|      p or q: max      false: -infinity     not p: -p
///
/// Above 0 the condition holds, below 0 it does not. Where an undefined difference leaves it open, as in
/// Kleene's logic, it is -infinity. Scratch inside: one object a thread.
class Margin {
 public:
  explicit Margin(const Program& condition);

  /// Exact before its last rounding where PointValue is.
  [[nodiscard]] double value(std::span<const Rational> slots);
  /// In double arithmetic.
  [[nodiscard]] double approximate(std::span<const double> slots);

  /// The comparisons in the condition, and the slots on which one depends.
  [[nodiscard]] std::size_t comparisons() const { return differences_.size(); }
  [[nodiscard]] std::vector<std::uint32_t> variables(std::size_t comparison) const {
    return formula_->comparisons[comparison].difference.variables();
  }
  /// The difference of the sides of a comparison, as value() and approximate() find it.
  [[nodiscard]] double difference(std::size_t comparison, std::span<const Rational> slots) {
    return differences_[comparison].value(slots);
  }
  [[nodiscard]] double approximate_difference(std::size_t comparison, std::span<const double> slots) {
    return differences_[comparison].approximate(slots);
  }
  /// The margin that follows from the differences of all comparisons.
  [[nodiscard]] double of_differences(std::span<const double> differences);

 private:
  std::unique_ptr<const Formula> formula_;
  std::vector<PointValue> differences_;
  std::vector<double> difference_values_;
  std::vector<double> node_values_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/requires.hpp"
#include "expression/domains.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {

/// The value of a number expression at a point, for simulation: correctly rounded where every operation is
/// rational, so that values that are equal on paper are equal; else in plain double arithmetic, without a
/// bound on its error. Scratch inside: one object a thread.
class PointValue {
 public:
  /// @pre `program` is a number. @pre unchecked: it outlives this object
  explicit PointValue(const Program& program)
      : variables_(program.variables()), fast_(program), exact_(program) {
    REQUIRES(!program.is_condition());
  }

  /// In double arithmetic. NaN where it is undefined.
  [[nodiscard]] double approximate(std::span<const double> slots) { return fast_.number(slots); }
  /// NaN where it is undefined.
  [[nodiscard]] double value(std::span<const Rational> slots);

 private:
  std::vector<std::uint32_t> variables_;  ///< only their slots are read
  Evaluator<double> fast_;
  Evaluator<RationalInterval> exact_;
  std::vector<RationalInterval> points_;
  std::vector<double> doubles_;
};

}  // namespace coordreq

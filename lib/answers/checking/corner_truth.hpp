#pragma once

#include <vector>

#include "answers/checking/sloped.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {

/// Proves or refutes a condition over a box where natural evaluation is too coarse: a difference that is
/// monotone in all variables has its extremes at corners of the box, exactly; in variables in which it is not
/// monotone the box is halved.
class CornerTruth {
 public:
  static constexpr int kMostBoxes = 512;

  /// @param variables slots of all variables of the condition
  CornerTruth(const Program& condition, std::vector<std::size_t> variables);

  /// `yes`: holds at every point of the closed box; `no`: fails (or is not defined) at some point of it.
  [[nodiscard]] Truth everywhere(std::vector<RationalInterval> box);

 private:
  /// A Sloped number whose comparisons use its corners.
  struct Cornered : Sloped<RationalInterval> {};
  friend Cornered from_rational(const Cornered* tag, const Rational& q);
  friend Cornered apply(Operator op, const Cornered& a);
  friend Cornered apply(Operator op, const Cornered& a, const Cornered& b);
  friend Truth compare(Operator op, const Cornered& a, const Cornered& b);
  friend Cornered select(Truth condition, const Cornered& a, const Cornered& b);

  [[nodiscard]] Truth visit(std::vector<RationalInterval>& box, int halvings);
  [[nodiscard]] bool holds_with_corners(const std::vector<RationalInterval>& box);
  [[nodiscard]] bool fails_at_a_point(const std::vector<RationalInterval>& box);

  std::vector<std::size_t> variables_;
  Evaluator<RationalInterval> exact_;
  Evaluator<Cornered> cornered_;
  int boxes_left_ = 0;
};

}  // namespace coordreq

#pragma once

#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {

/// Decides a condition over a box of its variables: double intervals first (fast), exact rational ones where
/// those leave it open (so that a cell that just touches the border of a set counts as it should).
/// Errs towards `undecided`. Scratch inside: one object a thread.
class ConditionDecider {
 public:
  /// REQUIRES: `condition` outlives this object and is a condition.
  explicit ConditionDecider(const Program& condition) : fast_(condition), exact_(condition) {}

  /// @param exact_box called only if needed, returns the box by slot as std::span<const RationalInterval>
  template <class ExactBox>
  [[nodiscard]] Truth decide(std::span<const Interval> box, const ExactBox& exact_box) {
    const Truth quick = fast_.condition(box);
    return quick != Truth::undecided ? quick : exact_.condition(exact_box());
  }

 private:
  Evaluator<Interval> fast_;
  Evaluator<RationalInterval> exact_;
};

}  // namespace coordreq

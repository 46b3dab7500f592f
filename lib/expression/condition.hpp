#pragma once

#include <memory>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "expression/sharp_condition.hpp"

namespace coordreq {

/// Decides a condition over a box of its variables: natural evaluation, in double intervals (fast), then in
/// exact rational ones where those leave it open (so that a cell that just touches the border of a set counts
/// as it should), then SharpCondition where a variable is repeated: where none is, natural evaluation is
/// already exact. Errs towards `undecided`. Scratch inside: one object a thread.
class ConditionDecider {
 public:
  /// @pre `condition` is a condition. @pre unchecked: it outlives this object
  explicit ConditionDecider(const Program& condition, Question question = Question::truth);

  /// @param box by slot
  /// @param exact_box called only if needed, returns the box by slot as std::span<const RationalInterval>
  template <class ExactBox>
  [[nodiscard]] Truth decide(std::span<const Interval> box, const ExactBox& exact_box) {
    const Truth quick = fast_.condition(box);
    if (quick != Truth::undecided || is_hopeless(box)) return quick;
    return decide_exactly(exact_box());
  }

 private:
  [[nodiscard]] bool is_hopeless(std::span<const Interval> box);
  [[nodiscard]] Truth decide_exactly(std::span<const RationalInterval> box);

  Evaluator<Interval> fast_;
  Evaluator<RationalInterval> exact_;
  std::vector<std::uint32_t> variables_;
  Question question_;
  std::unique_ptr<SharpCondition> sharp_;  ///< null if natural evaluation is all that can be done
  std::vector<Interval> corner_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "expression/condition.hpp"
#include "expression/truth_table.hpp"

namespace coordreq {

/// The condition says of itself that it may be undecided, where a memory does not know.
[[nodiscard]] bool may_not_know(const Program& condition);

/// The truth of a condition at a cell, comparison by comparison: each one is evaluated on all that its
/// variables can be there (see ConditionDecider; where there are several ranges, of all of them), and the
/// answers are joined by Kleene's rules. So the truth of a condition is one of its comparisons, however they
/// were decided.
///
/// Remembers its answers. Scratch inside: one object a thread.
class CellTruth {
 public:
  /// @param axes by slot; needed for the variables of the condition
  CellTruth(const Program& condition, std::vector<ConditionAxis> axes);

  /// @param indices by slot
  [[nodiscard]] Truth at(std::span<const std::int64_t> indices);

 private:
  struct Comparison {
    explicit Comparison(Program program);
    Program program;
    ConditionDecider decider;
    std::vector<std::uint32_t> variables;
    std::vector<std::uint8_t> known;  ///< by row-major number over the variables: 1 + truth, 0 if not known
  };
  struct Node {
    Operator op;
    std::uint32_t a = 0;  ///< among `nodes_`; of a comparison its number
    std::uint32_t b = 0;
  };

  [[nodiscard]] Truth of(Comparison& comparison, std::span<const std::int64_t> indices);
  [[nodiscard]] Truth decide(Comparison& comparison, std::span<const std::int64_t> indices);

  std::vector<ConditionAxis> axes_;
  std::deque<Comparison> comparisons_;
  std::vector<Node> nodes_;
  std::vector<Truth> truths_;
  std::vector<RationalInterval> exact_;  ///< by slot
  std::vector<Interval> fast_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "expression/formula.hpp"
#include "expression/sharp_comparison.hpp"

namespace coordreq {

/// The question about a condition over a box.
enum class Question : std::uint8_t {
  truth,       ///< `yes` and `no` are both worth work
  everywhere,  ///< only whether it holds at every point: `no` and `undecided` are the same answer
};

/// Decides a condition over a box where natural evaluation does not: comparisons one by one (see
/// SharpComparison), then halves of the box and halves of these, which decide it if all do alike.
///
/// The work is bounded by kMostBoxes boxes; it ends sooner where points of the box have shown that no answer
/// worth having is left, or a box of kMostCuts cuts is undecided. Deterministic. Scratch inside: one object a
/// thread.
class SharpCondition {
 public:
  static constexpr int kMostBoxes = 64;
  static constexpr int kMostCuts = 8;

  /// @param divisible slots of variables worth cutting
  SharpCondition(const Program& condition, std::vector<std::uint32_t> divisible, Question question);

  /// @param box by slot. @pre bounded and total
  [[nodiscard]] Truth decide(std::span<const RationalInterval> box);

 private:
  using Box = std::vector<RationalInterval>;

  [[nodiscard]] Truth visit(Box& box, std::vector<Truth> truths, int cuts);
  [[nodiscard]] Truth visit_halves(Box& box, const std::vector<Truth>& truths, int cuts);
  /// Evaluates the centre of the box; @returns false if no answer worth having is left.
  [[nodiscard]] bool is_worthwhile(const Box& box);
  [[nodiscard]] std::size_t widest(const Box& box) const;

  Formula formula_;
  std::vector<SharpComparison> comparisons_;
  Evaluator<RationalInterval> exact_;
  std::vector<std::uint32_t> divisible_;
  Question question_;
  Box whole_;
  int boxes_left_ = 0;
  bool may_be_yes_ = true;
  bool may_be_no_ = true;
};

}  // namespace coordreq

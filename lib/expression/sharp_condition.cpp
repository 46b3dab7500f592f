#include "expression/sharp_condition.hpp"

#include <algorithm>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {

SharpCondition::SharpCondition(const Program& condition, std::vector<std::uint32_t> divisible,
                               Question question)
    : formula_(take_apart(condition)),
      exact_(condition),
      divisible_(std::move(divisible)),
      question_(question) {
  comparisons_.reserve(formula_.comparisons.size());
  for (const Formula::Comparison& comparison : formula_.comparisons) comparisons_.emplace_back(comparison);
}

Truth SharpCondition::decide(std::span<const RationalInterval> box) {
  REQUIRES(
      std::ranges::all_of(box, [](const RationalInterval& range) { return range.bounded && range.total; }));
  whole_.assign(box.begin(), box.end());
  boxes_left_ = kMostBoxes;
  may_be_yes_ = true;
  may_be_no_ = question_ == Question::truth;
  Box subbox = whole_;
  return visit(subbox, std::vector<Truth>(comparisons_.size(), Truth::undecided), 0);
}

Truth SharpCondition::visit(Box& box, std::vector<Truth> truths, int cuts) {
  if (boxes_left_-- == 0) return Truth::undecided;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    // A comparison that is decided for a box is decided for its parts.
    if (truths[i] == Truth::undecided) truths[i] = comparisons_[i].decide(box);
  }
  const Truth truth = formula_.value(truths);
  if (truth != Truth::undecided) return truth;
  if (cuts == kMostCuts || !is_worthwhile(box)) return Truth::undecided;
  return visit_halves(box, truths, cuts);
}

Truth SharpCondition::visit_halves(Box& box, const std::vector<Truth>& truths, int cuts) {
  const std::size_t slot = widest(box);
  const RationalInterval range = box[slot];
  if (range.lower == range.upper) return Truth::undecided;
  const Rational middle = (range.lower + range.upper) / 2;
  box[slot].upper = middle;
  const Truth first = visit(box, truths, cuts + 1);
  box[slot] = range;
  if (first == Truth::undecided || (first == Truth::no && question_ == Question::everywhere)) {
    return Truth::undecided;
  }
  box[slot].lower = middle;
  const Truth second = visit(box, truths, cuts + 1);
  box[slot] = range;
  return second == first ? first : Truth::undecided;
}

bool SharpCondition::is_worthwhile(const Box& box) {
  Box centre = box;
  for (RationalInterval& range : centre) {
    range.lower = (range.lower + range.upper) / 2;
    range.upper = range.lower;
  }
  const Truth truth = exact_.condition(centre);
  may_be_yes_ = may_be_yes_ && truth != Truth::no;
  may_be_no_ = may_be_no_ && truth != Truth::yes;
  return may_be_yes_ || may_be_no_;
}

/// The variable that has been cut least, the first of several.
std::size_t SharpCondition::widest(const Box& box) const {
  std::size_t best = divisible_.front();
  Rational best_width = -1;
  for (const std::uint32_t slot : divisible_) {
    const Rational width = whole_[slot].upper - whole_[slot].lower;
    if (width == 0) continue;
    const Rational relative = (box[slot].upper - box[slot].lower) / width;
    if (relative > best_width) {
      best = slot;
      best_width = relative;
    }
  }
  return best;
}

}  // namespace coordreq

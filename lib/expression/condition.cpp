#include "expression/condition.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Corners of the first few variables: 16 points find out most boxes on a border.
constexpr std::size_t kMostCornerVariables = 4;
/// Taking a condition apart copies what its comparisons share.
constexpr std::size_t kMostNodes = std::size_t{1} << 20U;

/// Calls `visit` with the index of each operand of a node.
template <class Visit>
void for_each_operand(const Program::Node& node, const Visit& visit) {
  const std::size_t operands = operand_count(node.op);
  if (operands > 0) visit(node.a);
  if (operands > 1) visit(node.b);
  if (operands > 2) visit(node.c);
}

/// A double of the exact box that `range` encloses, next to one of its ends; the range itself if there is
/// none.
Interval near_end(const Interval& range, bool upper) {
  const double point =
      upper ? std::nextafter(range.upper, range.lower) : std::nextafter(range.lower, range.upper);
  const bool is_inside = range.is_point() || (range.lower < point && point < range.upper);
  return is_inside ? Interval{point, point} : range;
}

/// The variables that occur more than once: cut small enough, natural evaluation becomes exact.
std::vector<std::uint32_t> repeated_variables(const Program& condition) {
  std::vector<std::uint8_t> uses(condition.nodes.size(), 0);  // 2: several
  uses.back() = 1;
  std::vector<std::uint32_t> repeated;
  for (std::size_t i = condition.nodes.size(); i-- > 0;) {
    const Program::Node& node = condition.nodes[i];
    if (node.op == Operator::variable && uses[i] > 1) repeated.push_back(node.a);
    for_each_operand(node, [&](std::uint32_t operand) {
      uses[operand] = static_cast<std::uint8_t>(std::min(2, uses[operand] + uses[i]));
    });
  }
  return repeated;
}

std::size_t comparison_count(const Program& condition) {
  return static_cast<std::size_t>(
      std::count_if(condition.nodes.begin(), condition.nodes.end(),
                    [](const Program::Node& node) { return is_comparison(node.op); }));
}

}  // namespace

ConditionDecider::ConditionDecider(const Program& condition, Question question)
    : fast_(condition), exact_(condition), variables_(condition.variables()), question_(question) {
  REQUIRES(condition.is_condition());
  std::vector<std::uint32_t> repeated = repeated_variables(condition);
  if (repeated.empty() || condition.nodes.size() * comparison_count(condition) > kMostNodes) return;
  sharp_ = std::make_unique<SharpCondition>(condition, std::move(repeated), question);
}

/// True if points of the box show that no answer worth having is left.
bool ConditionDecider::is_hopeless(std::span<const Interval> box) {
  corner_.assign(box.begin(), box.end());
  const std::size_t dimensions = std::min(variables_.size(), kMostCornerVariables);
  bool may_be_yes = true;
  bool may_be_no = question_ == Question::truth;
  for (unsigned corner = 0; corner < 1U << dimensions; ++corner) {
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      corner_[variables_[j]] = near_end(box[variables_[j]], j < dimensions && (corner >> j & 1U) != 0);
    }
    const Truth truth = fast_.condition(corner_);
    may_be_yes = may_be_yes && truth != Truth::no;
    may_be_no = may_be_no && truth != Truth::yes;
    if (!may_be_yes && !may_be_no) return true;
  }
  return false;
}

Truth ConditionDecider::decide_exactly(std::span<const RationalInterval> box) {
  const Truth natural = exact_.condition(box);
  return natural == Truth::undecided && sharp_ ? sharp_->decide(box) : natural;
}

}  // namespace coordreq

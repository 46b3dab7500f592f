#include "answers/checking/corner_truth.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

/// With more variables a box has too many corners.
constexpr std::size_t kMostCornerVariables = 6;

bool keeps_its_sign(const RationalInterval& slope) {
  return slope.bounded && slope.total && (slope.lower >= 0 || slope.upper <= 0);
}

RationalInterval point_of(const Rational& q) {
  return {.lower = q, .upper = q};
}

}  // namespace

CornerTruth::Cornered from_rational(const CornerTruth::Cornered*, const Rational& q) {
  return {from_rational(static_cast<const Sloped<RationalInterval>*>(nullptr), q)};
}

CornerTruth::Cornered apply(Operator op, const CornerTruth::Cornered& a) {
  return {apply(op, static_cast<const Sloped<RationalInterval>&>(a))};
}

CornerTruth::Cornered apply(Operator op, const CornerTruth::Cornered& a, const CornerTruth::Cornered& b) {
  using Base = const Sloped<RationalInterval>&;
  return {apply(op, static_cast<Base>(a), static_cast<Base>(b))};
}

CornerTruth::Cornered select(Truth condition, const CornerTruth::Cornered& a,
                             const CornerTruth::Cornered& b) {
  using Base = const Sloped<RationalInterval>&;
  return {select(condition, static_cast<Base>(a), static_cast<Base>(b))};
}

Truth compare(Operator op, const CornerTruth::Cornered& a, const CornerTruth::Cornered& b) {
  using Base = const Sloped<RationalInterval>&;
  const Truth natural = compare(op, static_cast<Base>(a), static_cast<Base>(b));
  if (natural != Truth::undecided) return natural;
  const Sloped<RationalInterval> difference =
      apply(Operator::subtract, static_cast<Base>(a), static_cast<Base>(b));
  if (!difference.smooth || !difference.total || difference.corners.empty()) return Truth::undecided;
  if (!std::all_of(difference.gradient.begin(), difference.gradient.end(), keeps_its_sign))
    return Truth::undecided;
  RationalInterval range = difference.corners.front();
  for (const RationalInterval& corner : difference.corners) range = hull(range, corner);
  return compare(op, range, point_of(0));
}

CornerTruth::CornerTruth(const Program& condition, std::vector<std::size_t> variables)
    : variables_(std::move(variables)), exact_(condition), cornered_(condition) {}

Truth CornerTruth::everywhere(std::vector<RationalInterval> box) {
  boxes_left_ = kMostBoxes;
  return visit(box, 0);
}

Truth CornerTruth::visit(std::vector<RationalInterval>& box, int halvings) {
  if (exact_.condition(box) == Truth::yes || holds_with_corners(box)) return Truth::yes;
  if (fails_at_a_point(box)) return Truth::no;
  if (--boxes_left_ <= 0 || variables_.empty()) return Truth::undecided;
  const std::size_t slot = variables_[static_cast<std::size_t>(halvings) % variables_.size()];
  const RationalInterval whole = box[slot];
  const Rational middle = (whole.lower + whole.upper) / 2;
  box[slot].upper = middle;
  const Truth first = visit(box, halvings + 1);
  box[slot] = {.lower = middle, .upper = whole.upper};
  const Truth second = first == Truth::yes ? visit(box, halvings + 1) : first;
  box[slot] = whole;
  return second;
}

bool CornerTruth::holds_with_corners(const std::vector<RationalInterval>& box) {
  const std::size_t n = variables_.size();
  if (n > kMostCornerVariables) return false;
  std::vector<Cornered> slots(box.size());
  for (std::size_t j = 0; j < n; ++j) {
    Cornered& variable = slots[variables_[j]];
    variable.value = box[variables_[j]];
    variable.gradient.assign(n, point_of(0));
    variable.gradient[j] = point_of(1);
    for (std::size_t corner = 0; corner < std::size_t{1} << n; ++corner) {
      const bool upper = (corner >> j & 1U) != 0;
      variable.corners.push_back(point_of(upper ? variable.value.upper : variable.value.lower));
    }
  }
  return cornered_.condition(slots) == Truth::yes;
}

/// Whether the condition fails at a corner or at the centre of the box.
bool CornerTruth::fails_at_a_point(const std::vector<RationalInterval>& box) {
  std::vector<RationalInterval> point = box;
  const std::size_t n = std::min(variables_.size(), kMostCornerVariables);
  for (std::size_t corner = 0; corner <= std::size_t{1} << n; ++corner) {
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      const RationalInterval& range = box[variables_[j]];
      const bool upper = (corner >> j & 1U) != 0;
      Rational coordinate = upper ? range.upper : range.lower;
      if (corner == std::size_t{1} << n) coordinate = (range.lower + range.upper) / 2;
      point[variables_[j]] = point_of(coordinate);
    }
    if (exact_.condition(point) == Truth::no) return true;
  }
  return false;
}

}  // namespace coordreq

#include "expression/sharp_comparison.hpp"

#include <algorithm>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

bool is_finite(const Interval& a) {
  return a.lower > -outward::kInfinity && a.upper < outward::kInfinity;
}

RationalInterval end_of(const RationalInterval& range, bool upper) {
  const Rational& end = upper ? range.upper : range.lower;
  return {.lower = end, .upper = end};
}

}  // namespace

SharpComparison::SharpComparison(const Formula::Comparison& comparison)
    : op_(comparison.op),
      variables_(comparison.difference.variables()),
      directions_(std::min(variables_.size(), Dual::kDirections)),
      dual_(comparison.difference),
      fast_(comparison.difference),
      exact_(comparison.difference) {
  const std::size_t slots = variables_.empty() ? 0 : variables_.back() + std::size_t{1};
  box_.resize(slots);
  seeds_.resize(slots);
  centre_.resize(slots);
  ends_.resize(slots);
}

Truth SharpComparison::decide(std::span<const RationalInterval> box) {
  REQUIRES(std::ranges::all_of(variables_,
                               [&](std::uint32_t slot) { return box[slot].bounded && box[slot].total; }));
  const Dual& g = derivative(box);
  if (!g.total) return Truth::undecided;
  Truth result = truth(g.value.lower, g.value.upper);
  if (result == Truth::undecided) result = by_mean_value(g);
  if (result == Truth::undecided) result = by_monotonicity(box, g);
  return result;
}

Truth SharpComparison::truth(double lower, double upper) const {
  return truth_of(op_, {upper<0.0, lower> 0.0, upper <= 0.0, lower >= 0.0});
}

const Dual& SharpComparison::derivative(std::span<const RationalInterval> box) {
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const std::uint32_t slot = variables_[j];
    box_[slot] = enclose(box[slot]);
    seeds_[slot] = j < directions_ ? Dual::variable(box_[slot], j) : Dual::constant(box_[slot]);
  }
  return dual_.number(seeds_);
}

Truth SharpComparison::by_mean_value(const Dual& g) {
  if (g.jump.lower != 0.0 || g.jump.upper != 0.0) return Truth::undecided;
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const Interval& range = box_[variables_[j]];
    const double middle = midpoint(range);
    centre_[variables_[j]] = j < directions_ ? Interval{middle, middle} : range;
  }
  Interval range = fast_.number(centre_);
  for (std::size_t j = 0; j < g.directions; ++j) {
    if (!is_finite(g.gradient[j])) return Truth::undecided;
    range = range + g.gradient[j] * (box_[variables_[j]] - centre_[variables_[j]]);
  }
  return range.total ? truth(range.lower, range.upper) : Truth::undecided;
}

Truth SharpComparison::by_monotonicity(std::span<const RationalInterval> box, const Dual& g) {
  const bool jumps = g.jump.lower != 0.0 || g.jump.upper != 0.0;
  const auto bound = [&](bool upper) {
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      const std::uint32_t slot = variables_[j];
      const Interval slope = j < g.directions ? g.gradient[j] : Interval{0.0, 0.0};
      const bool grows = slope.lower >= 0.0;
      const bool monotone = !jumps && j < directions_ && (grows || slope.upper <= 0.0);
      ends_[slot] = monotone ? end_of(box[slot], grows == upper) : box[slot];
    }
    return exact_.number(ends_);
  };
  const RationalInterval low = bound(false);
  if (!low.bounded || !low.total) return Truth::undecided;
  const RationalInterval high = bound(true);
  if (!high.bounded || !high.total) return Truth::undecided;
  const Rational& least = low.lower;
  const Rational& greatest = high.upper;
  return truth_of(op_, {greatest<0, least> 0, greatest <= 0, least >= 0});
}

}  // namespace coordreq

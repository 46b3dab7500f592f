#include "reach/map_enclosure.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Each round fixes at least one more variable; more rounds than this are not worth their price.
constexpr int kRounds = 4;

std::vector<std::uint32_t> mentioned_among(const Program& equation, std::span<const std::uint32_t> slots) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t slot : equation.variables()) {
    if (std::find(slots.begin(), slots.end(), slot) != slots.end()) result.push_back(slot);
  }
  return result;
}

}  // namespace

MapEnclosure::MapEnclosure(const Program& equation, std::span<const std::uint32_t> box_slots)
    : natural_(equation),
      derivative_(equation),
      directions_(mentioned_among(equation, box_slots)),
      gradient_(directions_.size()),
      spread_(directions_.size()) {
  REQUIRES(!equation.is_condition());
}

Interval MapEnclosure::enclose(std::span<const Interval> slots) {
  const Interval natural = natural_.number(slots);
  reached_.reset();
  std::fill(spread_.begin(), spread_.end(), 0.0);
  if (natural.is_point() || directions_.empty()) reached_ = natural;
  if (!natural.total || reached_) return natural;
  const Interval lower = bounds(slots, false, natural);
  const Interval upper = bounds(slots, true, natural);
  return {lower.lower, upper.upper, true};
}

/// Bounds of f over a part of the box where its lower (or upper) extreme over the whole box lies.
Interval MapEnclosure::bounds(std::span<const Interval> slots, bool upper, const Interval& natural) {
  box_.assign(slots.begin(), slots.end());
  dual_.resize(slots.size());
  for (std::size_t s = 0; s < slots.size(); ++s) dual_[s] = Dual::constant(slots[s]);
  Interval result = natural;
  const auto tighten = [&](const Interval& range) { result = intersect(result, range).value_or(result); };
  for (int round = 0; round < kRounds; ++round) {
    tighten(evaluate_with_gradient());
    if (!move_to_extreme(upper)) break;
  }
  tighten(natural_.number(box_));
  tighten(mean_value_form());
  note_spread();
  return result;
}

/// By the mean value form over `box_`.
void MapEnclosure::note_spread() {
  if (jump_ > 0.0) std::fill(spread_.begin(), spread_.end(), 0.0);
  for (std::size_t j = 0; j < directions_.size() && jump_ == 0.0; ++j) {
    const Interval& range = box_[directions_[j]];
    if (!range.is_point())
      spread_[j] += (gradient_[j].upper - gradient_[j].lower) * (range.upper - range.lower);
  }
}

std::size_t MapEnclosure::loosest() const {
  const auto most = std::max_element(spread_.begin(), spread_.end());
  if (most == spread_.end() || *most == 0.0) return spread_.size();
  return static_cast<std::size_t>(most - spread_.begin());
}

/// f over `box_`, its gradient and jump left in the members.
const Interval& MapEnclosure::evaluate_with_gradient() {
  for (const std::uint32_t slot : directions_) dual_[slot] = Dual::constant(box_[slot]);
  for (std::size_t first = 0; first < directions_.size(); first += Dual::kDirections) {
    const std::size_t count = std::min(Dual::kDirections, directions_.size() - first);
    for (std::size_t j = 0; j < count; ++j) {
      const std::uint32_t slot = directions_[first + j];
      dual_[slot] = Dual::variable(box_[slot], j);
    }
    const Dual& value = derivative_.number(dual_);
    for (std::size_t j = 0; j < count; ++j) {
      gradient_[first + j] = j < value.directions ? value.gradient[j] : Interval{0.0, 0.0};
      dual_[directions_[first + j]] = Dual::constant(box_[directions_[first + j]]);
    }
    jump_ = value.jump.upper;
    value_ = value.value;
  }
  return value_;
}

/// @returns whether that changed the box
bool MapEnclosure::move_to_extreme(bool upper) {
  if (jump_ > 0.0) return false;
  bool changed = false;
  for (std::size_t j = 0; j < directions_.size(); ++j) {
    Interval& range = box_[directions_[j]];
    const Interval& gradient = gradient_[j];
    const bool rising = gradient.lower >= 0.0;
    if (range.is_point() || !(rising || gradient.upper <= 0.0)) continue;
    const double end = rising == upper ? range.upper : range.lower;
    range = {end, end};
    changed = true;
  }
  return changed;
}

/// With the gradient over `box_`, or over a box that contains it.
Interval MapEnclosure::mean_value_form() {
  middle_.assign(box_.begin(), box_.end());
  for (const std::uint32_t slot : directions_) {
    const double middle = midpoint(box_[slot]);
    middle_[slot] = {middle, middle};
  }
  const Interval value = natural_.number(middle_);
  reached_ = reached_ ? hull(*reached_, value) : value;
  Interval sum = value + Interval{-2.0 * jump_, 2.0 * jump_};
  for (std::size_t j = 0; j < directions_.size(); ++j) {
    const Interval& range = box_[directions_[j]];
    if (!range.is_point()) sum = sum + gradient_[j] * (range - middle_[directions_[j]]);
  }
  return sum;
}

}  // namespace coordreq

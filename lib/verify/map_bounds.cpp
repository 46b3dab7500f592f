#include "verify/map_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace coordreq {
namespace {

constexpr int kMostRounds = 4;

double middle_of(const Interval& a) {
  return std::clamp(a.lower + (a.upper - a.lower) / 2, a.lower, a.upper);
}

bool is_bounded(const Interval& a) {
  return a.total && std::isfinite(a.lower) && std::isfinite(a.upper);
}

bool keeps_its_sign(const Interval& slope) {
  return slope.total && (slope.lower >= 0.0 || slope.upper <= 0.0);
}

}  // namespace

MapBounds::MapBounds(const Program& equation, std::vector<std::uint32_t> variables)
    : variables_(std::move(variables)), natural_(equation), sloped_(equation) {}

std::optional<Interval> MapBounds::over(const std::vector<Interval>& slots, int halvings) {
  Box box = slots;
  return bounds(box, halvings);
}

bool MapBounds::follows(const std::vector<Interval>& slots, std::uint32_t slot) {
  const auto place = std::find(variables_.begin(), variables_.end(), slot);
  if (place == variables_.end()) return false;
  const Sloped<Interval>& f = evaluate(slots);
  if (!f.smooth || !f.total || f.gradient.empty()) return false;
  const Interval& slope = f.gradient[static_cast<std::size_t>(place - variables_.begin())];
  return slope.lower == 1.0 && slope.upper == 1.0;
}

const Sloped<Interval>& MapBounds::evaluate(const Box& box) {
  std::vector<Sloped<Interval>> slots(box.size());
  for (std::size_t s = 0; s < box.size(); ++s) slots[s].value = box[s];
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    slots[variables_[j]].gradient.assign(variables_.size(), Interval{0.0, 0.0});
    slots[variables_[j]].gradient[j] = {1.0, 1.0};
  }
  return sloped_.number(slots);
}

/// An enclosure of the extreme; the more variables turn out to be monotone, the smaller the box that is left.
Interval MapBounds::end_of(Box box, bool upper, int rounds) {
  const Sloped<Interval>& f = evaluate(box);
  bool changed = false;
  if (f.smooth && f.total && rounds < kMostRounds) {
    for (std::size_t j = 0; j < variables_.size() && !f.gradient.empty(); ++j) {
      Interval& range = box[variables_[j]];
      if (range.is_point() || !keeps_its_sign(f.gradient[j])) continue;
      const double end = (f.gradient[j].lower >= 0.0) == upper ? range.upper : range.lower;
      range = {end, end};
      changed = true;
    }
  }
  return changed ? end_of(std::move(box), upper, rounds + 1) : natural_.number(box);
}

std::optional<Interval> MapBounds::bounds(Box& box, int halvings_left) {
  const Sloped<Interval>& f = evaluate(box);
  std::optional<std::uint32_t> widest;
  double most = 0.0;
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const Interval& range = box[variables_[j]];
    const bool used = !f.smooth || !f.total || (!f.gradient.empty() && !keeps_its_sign(f.gradient[j]));
    if (range.is_point() || !used) continue;
    const double slope = f.gradient.empty() ? 1.0 : std::max(-f.gradient[j].lower, f.gradient[j].upper);
    const double width = (range.upper - range.lower) * (std::isfinite(slope) ? slope : 1e9);
    if (!widest || width > most) {
      widest = variables_[j];
      most = width;
    }
  }
  if (!widest || halvings_left == 0) {
    const Interval low = end_of(box, false, 0);
    const Interval high = end_of(box, true, 0);
    if (!is_bounded(low) || !is_bounded(high)) return std::nullopt;
    return Interval{low.lower, high.upper};
  }
  const Interval whole = box[*widest];
  const double middle = middle_of(whole);
  box[*widest] = {whole.lower, middle};
  const std::optional<Interval> first = bounds(box, halvings_left - 1);
  box[*widest] = {middle, whole.upper};
  const std::optional<Interval> second = first ? bounds(box, halvings_left - 1) : std::nullopt;
  box[*widest] = whole;
  if (!second) return std::nullopt;
  return hull(*first, *second);
}

}  // namespace coordreq

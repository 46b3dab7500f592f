#include "verify/map_extremes.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

/// Work on a box beside that on the equation: some is copied, a hull taken of each variable.
Work work_of_extreme(const SpanBox& box) {
  return 20 + 8 * static_cast<Work>(box.size());
}

/// Without slopes: the hull and the middle of each variable.
Extreme natural_extreme(SeriesField& field, const SpanBox& box, const Arb& natural, bool greatest) {
  field.add_work(16 * static_cast<Work>(box.size()));
  Extreme result{.bound = greatest ? natural.upper() : natural.lower()};
  for (const ArbSpan& span : box) result.start.push_back(span.middle());
  for (const std::uint32_t slot : field.variables()) result.excess.push_back(box[slot].width());
  return result;
}

/// From the value at a place that the slopes choose; its bound is not finite where that is not defined.
Extreme mean_value_extreme(SeriesField& field, std::size_t equation, const SpanBox& box,
                           const std::vector<Arb>& slopes, bool greatest) {
  Extreme result;
  for (const ArbSpan& span : box) result.start.push_back(span.lower);
  Arb excess;
  for (std::size_t j = 0; j < slopes.size(); ++j) {
    const std::uint32_t slot = field.variables()[j];
    EndChoice choice = choose_for_extreme(box[slot], slopes[j], greatest);
    result.excess.push_back(choice.excess.approximately());
    excess = excess + choice.excess;
    result.start[slot] = std::move(choice.point);
  }
  const Arb value = field.value(equation, result.start);
  if (value.is_finite()) result.attained = value;
  result.bound = greatest ? (value + excess).upper() : (value - excess).lower();
  return result;
}

}  // namespace

Extreme extreme_of(SeriesField& field, std::size_t equation, const SpanBox& box,
                   const std::optional<std::vector<Arb>>& slopes, bool greatest) {
  field.add_work(work_of_extreme(box));
  std::optional<Extreme> mean;
  if (slopes) mean = mean_value_extreme(field, equation, box, *slopes, greatest);
  const auto is_zero = [](double excess) { return excess == 0.0; };
  if (mean && mean->attained && std::all_of(mean->excess.begin(), mean->excess.end(), is_zero)) return *mean;
  const Arb range = field.value(equation, all_of(box));
  if (mean && mean->attained) {
    Arb bound = greatest ? range.upper() : range.lower();
    const bool is_better = !bound.is_finite() || is_below(mean->bound, bound) == greatest;
    if (!is_better) mean->bound = std::move(bound);
    return *mean;
  }
  Extreme natural = natural_extreme(field, box, range, greatest);
  const Arb value = field.value(equation, natural.start);
  if (value.is_finite()) natural.attained = value;
  return natural;
}

MapExtremes::MapExtremes(const SystemSpec& spec, const Influences& influences, std::size_t state)
    : map_(spec, influences, {state}) {}

bool MapExtremes::enclose(const SpanBox& box, const Effort&) {
  box_ = box;
  const ArbBox all = all_of(box);
  natural_ = map_.value(0, all);
  slopes_ = map_.slopes(0, all);
  return slopes_ || natural_.is_finite();
}

Extremes MapExtremes::extremes(std::size_t, const Enough& enough) {
  if (natural_.is_finite() && enough(natural_, natural_))
    return {natural_extreme(map_, box_, natural_, false), natural_extreme(map_, box_, natural_, true)};
  return {extreme_of(map_, 0, box_, slopes_, false), extreme_of(map_, 0, box_, slopes_, true)};
}

bool MapExtremes::follows(const ArbBox& box, std::uint32_t slot) {
  const auto found = std::find(map_.variables().begin(), map_.variables().end(), slot);
  if (found == map_.variables().end()) return false;
  const std::optional<std::vector<Arb>> slopes = map_.slopes(0, box);
  return slopes &&
         arb_is_one((*slopes)[static_cast<std::size_t>(found - map_.variables().begin())].get()) != 0;
}

}  // namespace coordreq

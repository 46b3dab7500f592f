#include "verify/map_extremes.hpp"

#include <algorithm>

namespace coordreq {
namespace {

Extreme natural_extreme(VectorField& field, const SpanBox& box, const Arb& natural, bool greatest) {
  Extreme result{.bound = greatest ? natural.upper() : natural.lower()};
  for (const ArbSpan& span : box) result.start.push_back(span.middle());
  for (const std::uint32_t slot : field.variables()) result.excess.push_back(box[slot].width());
  return result;
}

}  // namespace

Extreme extreme_of(VectorField& field, std::size_t equation, const SpanBox& box,
                   const std::optional<std::vector<Arb>>& slopes, const Arb& natural, bool greatest) {
  Extreme result = natural_extreme(field, box, natural, greatest);
  Arb excess;
  for (std::size_t j = 0; slopes && j < slopes->size(); ++j) {
    const std::uint32_t slot = field.variables()[j];
    const Choice choice = choose_for_extreme(box[slot], (*slopes)[j], greatest);
    result.start[slot] = choice.place;
    result.excess[j] = choice.excess.approximately();
    excess = excess + choice.excess;
  }
  const Arb value = field.value(equation, result.start);
  if (!value.is_finite()) return result;
  result.attained = value;
  if (!slopes) return result;
  const Arb bound = greatest ? (value + excess).upper() : (value - excess).lower();
  const bool is_better = !natural.is_finite() || is_below(bound, result.bound) == greatest;
  if (is_better) result.bound = bound;
  return result;
}

MapExtremes::MapExtremes(const ProblemSpec& spec, const Influences& influences, std::size_t state)
    : map_(spec, influences, {state}) {}

std::optional<Extremes> MapExtremes::extremes(const SpanBox& box, const Effort&, const Enough& enough) {
  const ArbBox all = all_of(box);
  const Arb natural = map_.value(0, all);
  if (natural.is_finite() && enough(natural, natural)) {
    return Extremes{natural_extreme(map_, box, natural, false), natural_extreme(map_, box, natural, true)};
  }
  const std::optional<std::vector<Arb>> slopes = map_.slopes(0, all);
  if (!slopes && !natural.is_finite()) return std::nullopt;
  return Extremes{extreme_of(map_, 0, box, slopes, natural, false),
                  extreme_of(map_, 0, box, slopes, natural, true)};
}

bool MapExtremes::follows(const ArbBox& box, std::uint32_t slot) {
  const auto place = std::find(map_.variables().begin(), map_.variables().end(), slot);
  if (place == map_.variables().end()) return false;
  const std::optional<std::vector<Arb>> slopes = map_.slopes(0, box);
  return slopes &&
         arb_is_one((*slopes)[static_cast<std::size_t>(place - map_.variables().begin())].get()) != 0;
}

}  // namespace coordreq

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "analysis/advice.hpp"
#include "base/grouped.hpp"
#include "spec/problem_spec.hpp"
#include "spec/state_bounds.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

/// Cells of a state: faces lie at face + k * step.
struct Faces {
  Rational step, face;
  [[nodiscard]] bool has(const Rational& value) const { return is_integer(Rational((value - face) / step)); }
};

Faces faces_of(const StateSpec& state) {
  return {state.grid.step, Rational(state.grid.first - state.grid.step / 2)};
}

/// Whether a bound lies within a cell, which has values on both sides of it.
bool cuts_a_cell(const StateSpec& state, const Rational& value) {
  const Rational half = state.grid.step / 2;
  const Rational last = state.grid.last();
  const Rational low = state.below == Outside::stop ? state.grid.first : Rational(state.grid.first - half);
  const Rational high = state.above == Outside::stop ? last : Rational(last + half);
  return low < value && value < high && !faces_of(state).has(value);
}

/// "\"origin\": 0.125", or a step that divides the present one as well, with which all bounds are faces;
/// nothing if no such step is a tenth of the present one or longer.
std::optional<std::string> remedy(const StateSpec& state, const std::vector<Rational>& values) {
  constexpr long kLargestDivisor = 10;
  for (long divisor = 1; divisor <= kLargestDivisor; ++divisor) {
    const Rational step = state.grid.step / Rational(divisor);
    const Faces faces{step, values.front()};
    if (!std::ranges::all_of(values, [&](const Rational& value) { return faces.has(value); })) continue;
    const Rational centre = values.front() + step / 2;
    const Rational origin =
        centre - step * Rational(mpz_class(static_cast<long>(floor_to_int(centre / step))));
    return (divisor == 1 ? "" : fmt::format("\"step\": {} and ", short_number(step))) +
           fmt::format("\"origin\": {}", short_number(origin));
  }
  return std::nullopt;
}

/// States that are bounded within cells, by what mends it.
struct CutCells {
  std::vector<std::string> locations;                      ///< "T1 at 18 and 24"
  std::map<std::string, std::vector<std::string>> mended;  ///< states by remedy

  void add(const StateSpec& state, const std::vector<Rational>& values) {
    std::vector<std::string> cut;
    for (const Rational& value : values)
      if (cuts_a_cell(state, value)) cut.push_back(short_number(value));
    if (cut.empty()) return;
    locations.push_back(state.name + " at " + list_text(cut));
    if (const std::optional<std::string> how = remedy(state, values)) mended[*how].push_back(state.name);
  }
};

}  // namespace

Warnings advise_on_bounds(const ProblemSpec& spec) {
  if (spec.abstraction.safe != Membership::inner) return {};
  std::vector<std::vector<Rational>> values(spec.states.size());
  for (const StateBound& bound : state_bounds(spec.safe, spec.states.size()))
    values[bound.state].push_back(bound.value);
  CutCells found;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    const bool has_faces =
        !state.discrete && state.below != Outside::periodic && state.measurement_error == 0;
    if (has_faces && !values[i].empty()) found.add(state, values[i]);
  }
  if (found.locations.empty()) return {};
  std::vector<std::string> remedies;
  for (const auto& [how, names] : found.mended) remedies.push_back(how + " for " + list_text(names));
  return {{"bound", "/safe",
           fmt::format("bounds of 'safe' lie within cells, which are not safe as a whole: {}{}",
                       fmt::join(found.locations, ", "),
                       remedies.empty()
                           ? ""
                           : fmt::format("; they are faces of cells with {}", fmt::join(remedies, ", ")))}};
}

}  // namespace coordreq

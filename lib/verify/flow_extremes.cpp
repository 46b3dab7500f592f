#include "verify/flow_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "verify/transition_matrix.hpp"

namespace coordreq {
namespace {

constexpr int kMostSteps = 128;

ArbMatrix columns(const ArbMatrix& a, std::size_t rows, std::size_t first, std::size_t count) {
  ArbMatrix result(rows, count);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < count; ++j) result.set(i, j, a(i, first + j));
  }
  return result;
}

bool all_finite(const std::vector<Arb>& values) {
  return std::all_of(values.begin(), values.end(), [](const Arb& value) { return value.is_finite(); });
}

std::vector<Arb> entries(const ArbMatrix& row, std::size_t count) {
  std::vector<Arb> result;
  for (std::size_t j = 0; j < count; ++j) result.push_back(row(0, j));
  return result;
}

}  // namespace

FlowExtremes::FlowExtremes(const ProblemSpec& spec, const Influences& influences, std::size_t state,
                           double cell)
    : field_(spec, influences, influences.moving),
      trajectory_(field_),
      period_(spec.dynamics.period),
      cell_(cell) {
  for (const std::size_t j : influences.moving) {
    if (j == state) position_ = states_.size();
    states_.push_back(spec.state_slot(j));
  }
  for (const std::size_t l : influences.disturbances) disturbances_.push_back(spec.disturbance_slot(l));
}

std::optional<Extremes> FlowExtremes::extremes(const SpanBox& box, const Effort& effort,
                                               const Enough& enough) {
  if (!enclose(box, effort)) return std::nullopt;
  Extremes result{bound_after(steps_.size(), false), bound_after(steps_.size(), true)};
  if (enough(result.least.bound, result.greatest.bound)) return result;
  result.least = extreme_after(steps_.size(), false);
  if (!enough(result.least.bound, result.greatest.bound))
    result.greatest = extreme_after(steps_.size(), true);
  return result;
}

/// Where the slopes would turn things round within a step, more steps are taken.
bool FlowExtremes::enclose(const SpanBox& box, const Effort& effort) {
  box_ = box;
  effort_ = effort;
  std::optional<std::vector<FlowStep>> steps = enclosed(effort.steps);
  const ArbBox start = all_of(box);
  const std::optional<ArbMatrix> slopes = steps ? steps->front().slopes : field_.jacobian(start);
  const int finer = slopes ? steps_for(*slopes, effort) : effort.steps;
  if (finer > effort.steps) steps = enclosed(finer);
  if (!steps) return false;
  steps_ = std::move(*steps);
  effort_.steps = static_cast<int>(steps_.size());
  step_ = period_ / Arb(static_cast<double>(effort_.steps));
  influences_.assign(steps_.size() + 1, std::nullopt);
  return true;
}

std::optional<std::vector<FlowStep>> FlowExtremes::enclosed(int steps) {
  const int pieces = effort_.steps < 8 ? 1 : std::min(effort_.steps / 4, 8);
  return enclose_flow(field_, box_, period_, steps, pieces);
}

int FlowExtremes::steps_for(const ArbMatrix& slopes, const Effort& effort) const {
  Arb norm;
  arb_mat_bound_inf_norm(arb_radref(norm.get()), columns(slopes, states_.size(), 0, states_.size()).get());
  const double turns = norm.upper().approximately() * period_.approximately();
  const double least = std::min(turns * std::max(1.0, effort.steps / 4.0), double{kMostSteps});
  return std::max(effort.steps, static_cast<int>(std::ceil(least)));
}

Extreme FlowExtremes::bound_after(std::size_t steps, bool greatest) const {
  Extreme result;
  const ArbSpan& end = steps == 0 ? box_[states_[position_]] : steps_[steps - 1].end[states_[position_]];
  result.bound = greatest ? end.upper.upper() : end.lower.lower();
  for (const ArbSpan& span : box_) result.start.push_back(span.middle());
  for (const std::uint32_t slot : states_) result.excess.push_back(box_[slot].width());
  return result;
}

Extreme FlowExtremes::extreme_after(std::size_t steps, bool greatest) {
  Extreme result = bound_after(steps, greatest);
  if (const std::optional<Influence>& influence = influence_after(steps))
    follow(*influence, steps, greatest, result);
  return result;
}

const std::optional<FlowExtremes::Influence>& FlowExtremes::influence_after(std::size_t steps) {
  auto& known = influences_[steps];
  if (!known) known = find_influence(steps);
  return *known;
}

std::optional<FlowExtremes::Influence> FlowExtremes::find_influence(std::size_t steps) const {
  const std::size_t n = states_.size();
  const std::size_t m = disturbances_.size();
  ArbMatrix row(1, n);
  row.set(0, position_, Arb(1.0));
  Influence result;
  result.of_disturbance.resize(steps);
  for (std::size_t k = steps; k-- > 0;) {
    if (!steps_[k].slopes) return std::nullopt;
    const ArbMatrix by_state = columns(*steps_[k].slopes, n, 0, n);
    if (m > 0) {
      const ArbMatrix within = row * transition_matrix(by_state, hull(Arb(), step_));
      result.of_disturbance[k] = entries(within * columns(*steps_[k].slopes, n, n, m), m);
      if (!all_finite(result.of_disturbance[k])) return std::nullopt;
    }
    row = row * transition_matrix(by_state, step_);
  }
  result.of_start = entries(row, n);
  if (!all_finite(result.of_start)) return std::nullopt;
  return result;
}

void FlowExtremes::follow(const Influence& influence, std::size_t steps, bool greatest, Extreme& extreme) {
  Arb excess;
  for (std::size_t j = 0; j < states_.size(); ++j) {
    const Choice choice = choose_for_extreme(box_[states_[j]], influence.of_start[j], greatest);
    extreme.start[states_[j]] = choice.place;
    extreme.excess[j] = choice.excess.approximately();
    excess = excess + choice.excess;
  }
  std::vector<std::vector<Arb>> signal(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    for (std::size_t l = 0; l < disturbances_.size(); ++l) {
      Choice choice = choose_for_extreme(box_[disturbances_[l]], influence.of_disturbance[k][l], greatest);
      excess = excess + choice.excess * step_;
      signal[k].push_back(std::move(choice.place));
    }
  }
  ArbBox now = extreme.start;
  const auto set_disturbances = [&](ArbBox& box, std::size_t k) {
    for (std::size_t l = 0; l < disturbances_.size(); ++l) box[disturbances_[l]] = signal[k][l];
  };
  if (steps > 0) set_disturbances(extreme.start, 0);
  const auto same = [](const std::vector<Arb>& a, const std::vector<Arb>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Arb& x, const Arb& y) { return arb_equal(x.get(), y.get()) != 0; });
  };
  for (std::size_t k = 0; k < steps;) {
    std::size_t end = k + 1;
    while (end < steps && same(signal[k], signal[end])) ++end;
    set_disturbances(now, k);
    const Arb duration =
        period_ * Arb(static_cast<double>(end - k)) / Arb(static_cast<double>(effort_.steps));
    if (!trajectory_.advance(now, duration, effort_.tolerance * cell_)) return;
    k = end;
  }
  const Arb& value = now[states_[position_]];
  extreme.attained = value;
  const Arb bound = greatest ? (value + excess).upper() : (value - excess).lower();
  if (is_below(bound, extreme.bound) == greatest) extreme.bound = bound;
}

}  // namespace coordreq

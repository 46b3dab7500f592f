#include "reach/point_dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "numeric/rational_functions.hpp"
#include "reach/point_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

PointDynamics::PointDynamics(const SystemSpec& spec)
    : spec_(&spec),
      affine_(spec),
      rows_(spec.states.size()),
      flows_(spec.states.size()),
      positions_(spec.states.size()) {}

PointDynamics::~PointDynamics() = default;
PointDynamics::PointDynamics(PointDynamics&&) noexcept = default;
PointDynamics& PointDynamics::operator=(PointDynamics&&) noexcept = default;

std::optional<Rational> PointDynamics::next(std::size_t i, const std::vector<Rational>& slots) {
  std::optional<Rational> value = exact_next(i, slots);
  if (!value) value = approximate_next(i, slots);
  if (value && bit_size(*value) > kMostBits) {
    throw LimitError(fmt::format("the exact value of '{}' needs more than {} bits, take fewer steps",
                                 spec_->states[i].name, kMostBits),
                     "--steps");
  }
  return value;
}

double PointDynamics::followed(std::size_t i) const {
  return flows_[i] ? flows_[i]->followed() : 0.0;
}

std::optional<Rational> PointDynamics::exact_next(std::size_t i, const std::vector<Rational>& slots) {
  if (const UpdateSpec* const update = spec_->dynamics.update(i)) {
    std::vector<RationalInterval> points;
    for (const Rational& value : slots) points.push_back({.lower = value, .upper = value});
    const RationalInterval value = Evaluator<RationalInterval>(update->value).number(points);
    return value.is_point() ? std::optional(value.lower) : std::nullopt;
  }
  const std::optional<SampledPoint>& point = row(i, slots).exact;
  if (!point) return std::nullopt;
  const Dependencies& dependencies = affine_.dependencies(i);
  Rational value = point->constant;
  for (std::size_t l = 0; l < point->disturbance.size(); ++l)
    value += point->disturbance[l] * slots[spec_->disturbance_slot(at(dependencies.disturbances[l]))];
  for (std::size_t j = 0; j < point->coefficient.size(); ++j)
    value += point->coefficient[j] * slots[spec_->state_slot(at(dependencies.moving[j]))];
  return value;
}

const PointDynamics::Row& PointDynamics::row(std::size_t i, const std::vector<Rational>& slots) {
  const Dependencies& dependencies = affine_.dependencies(i);
  key_.clear();
  for (const std::int32_t j : dependencies.parameters) key_.push_back(slots[spec_->state_slot(at(j))]);
  for (const std::int32_t j : dependencies.inputs) key_.push_back(slots[spec_->input_slot(at(j))]);
  const auto found = rows_[i].find(key_);
  if (found != rows_[i].end()) return found->second;
  Row row = find_row(i, slots);
  if (rows_[i].size() >= kMostRows) rows_[i].clear();
  return rows_[i].emplace(key_, std::move(row)).first->second;
}

PointDynamics::Row PointDynamics::find_row(std::size_t i, const std::vector<Rational>& slots) const {
  Row row{.exact = affine_.point_row(i, slots)};
  if (!row.exact) return row;
  const Dependencies& dependencies = affine_.dependencies(i);
  row.constant = nearest_double(row.exact->constant);
  row.has_doubles = row.exact->constant == 0 || std::isnormal(row.constant);
  const auto add = [&row](std::uint32_t slot, const Rational& factor) {
    if (factor == 0) return;
    row.summands.emplace_back(slot, nearest_double(factor));
    row.has_doubles = row.has_doubles && std::isnormal(row.summands.back().second);
  };
  for (std::size_t l = 0; l < row.exact->disturbance.size(); ++l)
    add(spec_->disturbance_slot(at(dependencies.disturbances[l])), row.exact->disturbance[l]);
  for (std::size_t j = 0; j < row.exact->coefficient.size(); ++j)
    add(spec_->state_slot(at(dependencies.moving[j])), row.exact->coefficient[j]);
  return row;
}

std::optional<PointDynamics::Estimate> PointDynamics::estimate(std::size_t i,
                                                               const std::vector<Rational>& slots,
                                                               const std::vector<double>& doubles) {
  if (spec_->dynamics.update(i) != nullptr) return std::nullopt;
  const Row& known = row(i, slots);
  if (!known.has_doubles) return std::nullopt;
  Estimate sum{.value = known.constant, .error = 0};
  double size = std::fabs(known.constant);
  for (const auto& [slot, factor] : known.summands) {
    if (slots[slot] == 0) continue;
    const double summand = factor * doubles[slot];
    if (!std::isnormal(doubles[slot]) || !std::isnormal(summand)) return std::nullopt;
    sum.value += summand;
    size += std::fabs(summand);
  }
  // Normal numbers: three roundings make a summand, one each adds it; they err by half of epsilon, so that as
  // much again is to spare.
  const auto roundings = static_cast<double>(known.summands.size() + 4);
  sum.error = roundings * std::numeric_limits<double>::epsilon() * size;
  return sum;
}

std::optional<Rational> PointDynamics::approximate_next(std::size_t i, const std::vector<Rational>& slots) {
  doubles_.clear();
  for (const Rational& value : slots) doubles_.push_back(nearest_double(value));
  const std::optional<double> found = double_next(i);
  if (!found || !std::isfinite(*found)) return std::nullopt;
  const StateSpec& state = spec_->states[i];
  if (!state.discrete) return exact(*found);
  const std::int64_t k = floor_to_int((exact(*found) - state.grid.first) / state.grid.step + Rational(1) / 2);
  return Rational(state.grid.first + state.grid.step * Rational(static_cast<long>(k)));
}

std::optional<double> PointDynamics::double_next(std::size_t i) {
  if (const UpdateSpec* const update = spec_->dynamics.update(i))
    return Evaluator<double>(update->value).number(doubles_);
  if (spec_->dynamics.time == Time::discrete) {
    return Evaluator<double>(spec_->dynamics.equations[i]).number(doubles_);
  }
  if (!flows_[i]) {
    const std::vector<std::int32_t>& moving = affine_.dependencies(i).moving;
    flows_[i] = std::make_unique<PointFlow>(*spec_, moving);
    const auto found = std::find(moving.begin(), moving.end(), static_cast<std::int32_t>(i));
    positions_[i] = static_cast<std::size_t>(found - moving.begin());
  }
  const std::optional<std::vector<double>> end = flows_[i]->after_period(doubles_);
  if (!end) return std::nullopt;
  return (*end)[positions_[i]];
}

}  // namespace coordreq

#include "reach/point_dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "numeric/rational_functions.hpp"
#include "reach/point_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

PointDynamics::PointDynamics(const SystemSpec& spec)
    : spec_(&spec),
      pinned_(std::make_unique<SystemSpec>(spec)),
      affine_(*pinned_),
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
  const Dependencies& dependencies = affine_.dependencies(i);
  for (const std::int32_t j : dependencies.disturbances) {
    const auto l = static_cast<std::size_t>(j);
    pinned_->disturbances[l].lower = pinned_->disturbances[l].upper = slots[spec_->disturbance_slot(l)];
  }
  const std::optional<SampledRow> row = affine_.row(i, slots);
  if (!row || !row->exact || row->lower != row->upper) return std::nullopt;
  Rational value = row->lower;
  for (std::size_t j = 0; j < row->coefficient.size(); ++j) {
    value += row->coefficient[j] * slots[spec_->state_slot(static_cast<std::size_t>(dependencies.moving[j]))];
  }
  return value;
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
    const auto own = std::find(moving.begin(), moving.end(), static_cast<std::int32_t>(i));
    positions_[i] = static_cast<std::size_t>(own - moving.begin());
  }
  const std::optional<std::vector<double>> end = flows_[i]->after_period(doubles_);
  if (!end) return std::nullopt;
  return (*end)[positions_[i]];
}

}  // namespace coordreq

#include "reach/affine_dynamics.hpp"

#include <algorithm>

#include "reach/affine_form.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

AffineDynamics::AffineDynamics(const SystemSpec& spec) : spec_(&spec) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) dependencies_.push_back(find_dependencies(spec, i));
}

bool AffineDynamics::has_limit(std::size_t state) const {
  const std::vector<std::int32_t>& moving = dependencies_[state].moving;
  return std::any_of(moving.begin(), moving.end(), [&](std::int32_t j) {
    return spec_->states[static_cast<std::size_t>(j)].has(Outside::stop);
  });
}

std::optional<SampledRow> AffineDynamics::row(std::size_t state, const std::vector<Rational>& slots,
                                              Limits limits) const {
  if (limits == Limits::obeyed && has_limit(state)) return std::nullopt;
  return spec_->dynamics.time == Time::discrete ? map_row(state, slots) : flow_row(state, slots);
}

std::optional<SampledRow> AffineDynamics::map_row(std::size_t state,
                                                  const std::vector<Rational>& slots) const {
  const Dependencies& dependencies = dependencies_[state];
  const std::optional<AffineForm> form = affine_form(*spec_, state, dependencies, slots);
  if (!form) return std::nullopt;
  SampledRow row{.coefficient = {form->state.begin(), form->state.end()},
                 .lower = form->lower,
                 .upper = form->upper,
                 .exact = form->lower == form->upper};
  for (std::size_t l = 0; l < dependencies.disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec_->disturbances[static_cast<std::size_t>(dependencies.disturbances[l])];
    const Rational& factor = form->disturbance(static_cast<Eigen::Index>(l));
    const Rational at_lower = factor * w.lower;
    const Rational at_upper = factor * w.upper;
    row.lower += std::min(at_lower, at_upper);
    row.upper += std::max(at_lower, at_upper);
  }
  return row;
}

std::optional<SampledPoint> AffineDynamics::point_row(std::size_t state,
                                                      const std::vector<Rational>& slots) const {
  if (has_limit(state)) return std::nullopt;
  return spec_->dynamics.time == Time::discrete ? map_point(state, slots) : flow_point(state, slots);
}

std::optional<SampledPoint> AffineDynamics::map_point(std::size_t state,
                                                      const std::vector<Rational>& slots) const {
  const std::optional<AffineForm> form = affine_form(*spec_, state, dependencies_[state], slots);
  if (!form || form->lower != form->upper) return std::nullopt;
  return SampledPoint{.coefficient = {form->state.begin(), form->state.end()},
                      .disturbance = {form->disturbance.begin(), form->disturbance.end()},
                      .constant = form->lower};
}

}  // namespace coordreq

#include <algorithm>
#include <utility>

#include "reach/absolute_integral.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/nilpotent_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// The integral of sum_k coefficient[k] * s^k over [0, end].
Rational integral_of(const std::vector<Rational>& coefficient, const Rational& end) {
  Rational integral = 0;
  for (std::size_t k = coefficient.size(); k-- > 0;) {
    integral = (integral + coefficient[k] / Rational(static_cast<long>(k + 1))) * end;
  }
  return integral;
}

}  // namespace

std::optional<SampledRow> AffineDynamics::constant_row(std::size_t state,
                                                       const std::vector<Rational>& slots) const {
  const std::vector<std::int32_t>& moving = dependencies_[state].moving;
  if (std::find(moving.begin(), moving.end(), static_cast<std::int32_t>(state)) != moving.end()) {
    return std::nullopt;
  }
  const Rational& value = slots[spec_->state_slot(state)];
  return SampledRow{.coefficient = std::vector<Rational>(moving.size()), .lower = value, .upper = value};
}

std::optional<SampledRow> AffineDynamics::flow_row(std::size_t state,
                                                   const std::vector<Rational>& slots) const {
  if (const std::optional<SampledRow> constant = constant_row(state, slots)) return constant;
  const Dependencies& dependencies = dependencies_[state];
  const std::optional<NilpotentFlow> flow = nilpotent_flow(*spec_, state, dependencies, slots);
  if (!flow) return std::nullopt;
  const Rational& tau = spec_->dynamics.period;
  const Eigen::Index terms = flow->rows.rows();
  const RationalVector weights = exponential_terms(tau, terms + 1);
  const RationalRow coefficient = product(weights.head(terms).transpose(), flow->rows);
  SampledRow result{.coefficient = {coefficient.begin(), coefficient.end()},
                    .lower = product(weights.tail(terms).transpose(), flow->lower).value(),
                    .upper = product(weights.tail(terms).transpose(), flow->upper).value(),
                    .exact = flow->lower == flow->upper};
  for (std::size_t l = 0; l < dependencies.disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec_->disturbances[static_cast<std::size_t>(dependencies.disturbances[l])];
    const Rational middle = (w.lower + w.upper) / 2;
    const Rational radius = (w.upper - w.lower) / 2;
    const std::vector<Rational> kernel = flow->kernel(l);
    const Rational integral = integral_of(kernel, tau);
    const AbsoluteIntegral absolute = integral_of_absolute(kernel, tau);
    result.lower += middle * integral - radius * absolute.value;
    result.upper += middle * integral + radius * absolute.value;
    if (!absolute.exact && radius != 0) result.exact = false;
  }
  return result;
}

std::optional<SampledPoint> AffineDynamics::flow_point(std::size_t state,
                                                       const std::vector<Rational>& slots) const {
  if (std::optional<SampledRow> constant = constant_row(state, slots))
    return SampledPoint{.coefficient = std::move(constant->coefficient),
                        .disturbance = std::vector<Rational>(dependencies_[state].disturbances.size()),
                        .constant = constant->lower};
  const std::optional<NilpotentFlow> flow = nilpotent_flow(*spec_, state, dependencies_[state], slots);
  if (!flow || flow->lower != flow->upper) return std::nullopt;
  const Rational& tau = spec_->dynamics.period;
  const Eigen::Index terms = flow->rows.rows();
  const RationalVector weights = exponential_terms(tau, terms + 1);
  const RationalRow coefficient = product(weights.head(terms).transpose(), flow->rows);
  SampledPoint point{.coefficient = {coefficient.begin(), coefficient.end()},
                     .disturbance = {},
                     .constant = product(weights.tail(terms).transpose(), flow->lower).value()};
  for (std::size_t l = 0; l < dependencies_[state].disturbances.size(); ++l)
    point.disturbance.push_back(integral_of(flow->kernel(l), tau));
  return point;
}

}  // namespace coordreq

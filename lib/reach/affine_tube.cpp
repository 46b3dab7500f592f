// Where x' = A x + B w + c with nilpotent A is during a period. The bounds of x_i(t) are polynomials in t
// (NilpotentFlow), so their Bernstein coefficients over [0, tau] enclose them; the first and the last are the
// values at 0 and tau, so motion in one direction is enclosed exactly.

#include "reach/absolute_integral.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/nilpotent_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

using Coefficients = std::vector<Rational>;

/// The integral from 0 to t of sum_k kernel[k] s^k, as a polynomial in t.
Coefficients antiderivative(const Coefficients& kernel) {
  Coefficients result = {0};
  for (std::size_t k = 0; k < kernel.size(); ++k) {
    result.emplace_back(kernel[k] / Rational(static_cast<long>(k + 1)));
  }
  return result;
}

/// A bound of the integral from 0 to t of |kernel|, as a polynomial in t; exact where the kernel keeps its
/// sign.
Coefficients absolute_antiderivative(const Coefficients& kernel, const Rational& tau) {
  Coefficients result = antiderivative(kernel);
  const Rational integral = to_bernstein(result, tau).back();
  const AbsoluteIntegral absolute = integral_of_absolute(kernel, tau);
  const bool keeps_sign = absolute.exact && absolute.value == abs(integral);
  for (Rational& c : result) {
    if (keeps_sign ? integral < 0 : c < 0) c = -c;
  }
  return result;
}

/// Bounds of what does not come from the initial state, as polynomials in t.
struct Bounds {
  Coefficients lower;
  Coefficients upper;
};

Bounds bounds_of_the_rest(const NilpotentFlow& flow, const RationalVector& inverse_factorials) {
  Bounds bounds{{0}, {0}};
  for (Eigen::Index k = 0; k < flow.rows.rows(); ++k) {
    bounds.lower.emplace_back(flow.lower(k) * inverse_factorials(k + 1));
    bounds.upper.emplace_back(flow.upper(k) * inverse_factorials(k + 1));
  }
  return bounds;
}

void add_disturbance(const DisturbanceSpec& w, const Coefficients& kernel, const Rational& tau,
                     Bounds& bounds) {
  const Rational middle = (w.lower + w.upper) / 2;
  const Rational radius = (w.upper - w.lower) / 2;
  const Coefficients mean = antiderivative(kernel);
  const Coefficients spread = absolute_antiderivative(kernel, tau);
  for (std::size_t k = 0; k < mean.size(); ++k) {
    bounds.lower[k] += middle * mean[k] - radius * spread[k];
    bounds.upper[k] += middle * mean[k] + radius * spread[k];
  }
}

}  // namespace

std::optional<std::vector<SampledRow>> AffineDynamics::tube_rows(std::size_t state,
                                                                 const std::vector<Rational>& slots,
                                                                 Limits limits) const {
  if (limits == Limits::obeyed && has_limit(state)) return std::nullopt;
  if (const std::optional<SampledRow> constant = constant_row(state, slots)) return std::vector{*constant};
  const Dependencies& dependencies = dependencies_[state];
  const std::optional<NilpotentFlow> flow = nilpotent_flow(*spec_, state, dependencies, slots);
  if (!flow) return std::nullopt;
  const Rational& tau = spec_->dynamics.period;
  const Eigen::Index terms = flow->rows.rows();
  const RationalVector inverse_factorials = exponential_terms(1, terms + 1);
  Bounds bounds = bounds_of_the_rest(*flow, inverse_factorials);
  for (std::size_t l = 0; l < dependencies.disturbances.size(); ++l) {
    const auto index = static_cast<std::size_t>(dependencies.disturbances[l]);
    add_disturbance(spec_->disturbances[index], flow->kernel(l), tau, bounds);
  }
  const Coefficients lower = to_bernstein(bounds.lower, tau);
  const Coefficients upper = to_bernstein(bounds.upper, tau);
  std::vector<SampledRow> rows;
  for (std::size_t m = 0; m < lower.size(); ++m) {
    rows.push_back({.coefficient = {}, .lower = lower[m], .upper = upper[m], .exact = false});
  }
  for (Eigen::Index j = 0; j < flow->rows.cols(); ++j) {
    Coefficients coefficient(lower.size());
    for (Eigen::Index k = 0; k < terms; ++k) {
      coefficient[static_cast<std::size_t>(k)] = flow->rows(k, j) * inverse_factorials(k);
    }
    const Coefficients control = to_bernstein(coefficient, tau);
    for (std::size_t m = 0; m < rows.size(); ++m) rows[m].coefficient.push_back(control[m]);
  }
  return rows;
}

}  // namespace coordreq

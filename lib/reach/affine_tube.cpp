// Where x' = A x + B w + c with nilpotent A is during a period. The bounds of x_i(t) are polynomials in t
// (see sampled_flow.cpp, with t in place of tau), so their Bernstein coefficients over [0, tau] enclose them;
// the first and the last are the values at 0 and tau, so motion in one direction is enclosed exactly.

#include "reach/absolute_integral.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/bernstein.hpp"

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

}  // namespace

std::optional<std::vector<SampledRow>> AffineDynamics::tube_rows(std::size_t state,
                                                                 const std::vector<Rational>& slots,
                                                                 Limits limits) const {
  if (limits == Limits::obeyed && has_limit(state)) return std::nullopt;
  if (const std::optional<SampledRow> constant = constant_row(state, slots)) return std::vector{*constant};
  const std::optional<NilpotentFlow> flow = nilpotent_flow(state, slots);
  if (!flow) return std::nullopt;
  const Rational& tau = spec_->dynamics.period;
  const std::size_t terms = flow->rows.size();
  std::vector<Coefficients> coefficient(flow->forms.size(), Coefficients(terms + 1));
  Coefficients lower(terms + 1);
  Coefficients upper(terms + 1);
  Rational factorial = 1;
  for (std::size_t k = 0; k < terms; ++k) {
    const Rational next = factorial * Rational(static_cast<long>(k + 1));
    for (std::size_t j = 0; j < coefficient.size(); ++j) {
      const Rational& r = flow->rows[k][j];
      const AffineForm& form = flow->forms[j];
      coefficient[j][k] = r / factorial;
      lower[k + 1] += r / next * (r > 0 ? form.lower : form.upper);
      upper[k + 1] += r / next * (r > 0 ? form.upper : form.lower);
    }
    factorial = next;
  }
  for (std::size_t l = 0; l < flow->kernels.size(); ++l) {
    const auto index = static_cast<std::size_t>(dependencies_[state].disturbances[l]);
    const DisturbanceSpec& w = spec_->disturbances[index];
    const Rational middle = (w.lower + w.upper) / 2;
    const Rational radius = (w.upper - w.lower) / 2;
    const Coefficients mean = antiderivative(flow->kernels[l]);
    const Coefficients spread = absolute_antiderivative(flow->kernels[l], tau);
    for (std::size_t k = 0; k <= terms; ++k) {
      lower[k] += middle * mean[k] - radius * spread[k];
      upper[k] += middle * mean[k] + radius * spread[k];
    }
  }

  std::vector<SampledRow> rows(terms + 1,
                               SampledRow{.coefficient = {}, .lower = 0, .upper = 0, .exact = false});
  for (const Coefficients& one : coefficient) {
    const Coefficients control = to_bernstein(one, tau);
    for (std::size_t m = 0; m <= terms; ++m) rows[m].coefficient.push_back(control[m]);
  }
  const Coefficients lowest = to_bernstein(lower, tau);
  const Coefficients highest = to_bernstein(upper, tau);
  for (std::size_t m = 0; m <= terms; ++m) {
    rows[m].lower = lowest[m];
    rows[m].upper = highest[m];
  }
  return rows;
}

}  // namespace coordreq

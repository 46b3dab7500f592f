// The sampled flow of x' = A x + B w + c with nilpotent A, one row of the result at a time:
//   x_i(tau) = sum_k r_k x(0) tau^k / k! + sum_k r_k c tau^(k+1) / (k+1)! + integral of g(s) w(tau - s) ds,
//   r_0 = e_i, r_{k+1} = r_k A, g(s) = sum_k r_k B s^k / k!.
// The sums end because A is nilpotent, so everything is rational. A measurable w in a box reaches every value
// of mid * integral(g) +- radius * integral(|g|), both ends included (bang-bang).

#include <algorithm>

#include "reach/absolute_integral.hpp"
#include "reach/affine_dynamics.hpp"

namespace coordreq {
namespace {

using Row = std::vector<Rational>;

Row times(const Row& row, const std::vector<Row>& matrix) {
  Row result(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0) continue;
    for (std::size_t j = 0; j < row.size(); ++j) result[j] += row[i] * matrix[i][j];
  }
  return result;
}

bool is_zero(const Row& row) {
  for (const Rational& q : row) {
    if (q != 0) return false;
  }
  return true;
}

/// r_0, r_1, ... up to the last that is not zero; empty if r_n is not zero (not nilpotent).
std::vector<Row> krylov_rows(std::size_t start, const std::vector<Row>& matrix) {
  std::vector<Row> rows;
  Row row(matrix.size());
  row[start] = 1;
  for (std::size_t k = 0; k <= matrix.size(); ++k) {
    if (is_zero(row)) return rows;
    rows.push_back(row);
    row = times(row, matrix);
  }
  return {};
}

/// Of sum_k coefficient[k] * s^k over [0, end].
Rational integral_of(const std::vector<Rational>& coefficient, const Rational& end) {
  Rational integral = 0;
  Rational power = end;
  for (std::size_t k = 0; k < coefficient.size(); ++k, power *= end) {
    integral += coefficient[k] * power / Rational(static_cast<long>(k + 1));
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
  return SampledRow{.coefficient = Row(moving.size()), .lower = value, .upper = value};
}

/// An equation that uses a periodic state as a number is affine only until that passes its seam.
bool AffineDynamics::jumps_at_a_seam(const AffineForm& form, const Dependencies& dependencies) const {
  for (std::size_t j = 0; j < form.state.size(); ++j) {
    const StateSpec& used = spec_->states[static_cast<std::size_t>(dependencies.moving[j])];
    if (form.state[j] != 0 && used.above == Outside::periodic) return true;
  }
  return false;
}

std::optional<AffineDynamics::NilpotentFlow> AffineDynamics::nilpotent_flow(
    std::size_t state, const std::vector<Rational>& slots) const {
  const Dependencies& dependencies = dependencies_[state];
  NilpotentFlow flow;
  std::vector<Row> matrix;
  std::size_t start = 0;
  for (const std::int32_t j : dependencies.moving) {
    if (static_cast<std::size_t>(j) == state) start = flow.forms.size();
    const std::optional<AffineForm> form = affine_form(static_cast<std::size_t>(j), dependencies, slots);
    if (!form || jumps_at_a_seam(*form, dependencies)) return std::nullopt;
    flow.forms.push_back(*form);
    matrix.push_back(form->state);
  }
  flow.rows = krylov_rows(start, matrix);
  if (flow.rows.empty()) return std::nullopt;
  flow.kernels.resize(dependencies.disturbances.size());
  Rational factorial = 1;
  for (std::size_t k = 0; k < flow.rows.size(); ++k) {
    for (std::size_t l = 0; l < flow.kernels.size(); ++l) {
      Rational sum = 0;
      for (std::size_t j = 0; j < matrix.size(); ++j) sum += flow.rows[k][j] * flow.forms[j].disturbance[l];
      flow.kernels[l].emplace_back(sum / factorial);
    }
    factorial *= Rational(static_cast<long>(k + 1));
  }
  return flow;
}

std::optional<SampledRow> AffineDynamics::flow_row(std::size_t state,
                                                   const std::vector<Rational>& slots) const {
  if (const std::optional<SampledRow> constant = constant_row(state, slots)) return constant;
  const std::optional<NilpotentFlow> flow = nilpotent_flow(state, slots);
  if (!flow) return std::nullopt;
  const Rational& tau = spec_->dynamics.period;
  const std::vector<AffineForm>& forms = flow->forms;

  SampledRow result{.coefficient = Row(forms.size()), .lower = 0, .upper = 0};
  Rational weight = 1;  // tau^k / k!
  for (std::size_t k = 0; k < flow->rows.size(); ++k) {
    const Rational next = weight * tau / Rational(static_cast<long>(k + 1));
    for (std::size_t j = 0; j < forms.size(); ++j) {
      const Rational& r = flow->rows[k][j];
      if (r == 0) continue;
      result.coefficient[j] += r * weight;
      result.lower += r * next * (r > 0 ? forms[j].lower : forms[j].upper);
      result.upper += r * next * (r > 0 ? forms[j].upper : forms[j].lower);
      if (forms[j].lower != forms[j].upper) result.exact = false;
    }
    weight = next;
  }

  for (std::size_t l = 0; l < flow->kernels.size(); ++l) {
    const auto index = static_cast<std::size_t>(dependencies_[state].disturbances[l]);
    const DisturbanceSpec& w = spec_->disturbances[index];
    const Rational middle = (w.lower + w.upper) / 2;
    const Rational radius = (w.upper - w.lower) / 2;
    const std::vector<Rational>& kernel = flow->kernels[l];
    const Rational integral = integral_of(kernel, tau);
    const AbsoluteIntegral absolute = integral_of_absolute(kernel, tau);
    result.lower += middle * integral - radius * absolute.value;
    result.upper += middle * integral + radius * absolute.value;
    if (!absolute.exact && radius != 0) result.exact = false;
  }
  return result;
}

}  // namespace coordreq

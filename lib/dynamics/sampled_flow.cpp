// The sampled flow of x' = A x + B w + c with nilpotent A, one row of the result at a time:
//   x_i(tau) = sum_k r_k x(0) tau^k / k! + sum_k r_k c tau^(k+1) / (k+1)! + integral of g(s) w(tau - s) ds,
//   r_0 = e_i, r_{k+1} = r_k A, g(s) = sum_k r_k B s^k / k!.
// The sums end because A is nilpotent, so everything is rational. A measurable w in a box reaches every value
// of mid * integral(g) +- radius * integral(|g|), both ends included (bang-bang).

#include <algorithm>

#include "dynamics/absolute_integral.hpp"
#include "dynamics/affine_dynamics.hpp"

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

}  // namespace

std::optional<SampledRow> AffineDynamics::flow_row(std::size_t state,
                                                   const std::vector<Rational>& slots) const {
  const Dependencies& dependencies = dependencies_[state];
  const Rational& tau = spec_->dynamics.period;
  if (std::find(dependencies.moving.begin(), dependencies.moving.end(), static_cast<std::int32_t>(state)) ==
      dependencies.moving.end()) {
    const Rational& value = slots[spec_->state_slot(state)];  // a discrete state that stays what it is
    return SampledRow{.coefficient = Row(dependencies.moving.size()), .lower = value, .upper = value};
  }
  std::vector<AffineForm> forms;
  std::vector<Row> matrix;
  std::size_t start = 0;
  for (const std::int32_t j : dependencies.moving) {
    if (static_cast<std::size_t>(j) == state) start = forms.size();
    const StateSpec& moving = spec_->states[static_cast<std::size_t>(j)];
    if (moving.below == Outside::stop || moving.above == Outside::stop) return std::nullopt;
    const std::optional<AffineForm> form = affine_form(static_cast<std::size_t>(j), dependencies, slots);
    if (!form) return std::nullopt;
    forms.push_back(*form);
    matrix.push_back(forms.back().state);
  }
  const std::vector<Row> rows = krylov_rows(start, matrix);
  if (rows.empty()) return std::nullopt;

  SampledRow result{.coefficient = Row(forms.size()), .lower = 0, .upper = 0};
  std::vector<Row> kernels(
      dependencies.disturbances.size());  // coefficients of g, one polynomial a disturbance
  Rational weight = 1;                    // tau^k / k!
  Rational factorial = 1;                 // k!
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Rational next = weight * tau / Rational(static_cast<long>(k + 1));
    for (std::size_t l = 0; l < kernels.size(); ++l) kernels[l].emplace_back(0);
    for (std::size_t j = 0; j < forms.size(); ++j) {
      const Rational& r = rows[k][j];
      if (r == 0) continue;
      result.coefficient[j] += r * weight;
      result.lower += r * next * (r > 0 ? forms[j].lower : forms[j].upper);
      result.upper += r * next * (r > 0 ? forms[j].upper : forms[j].lower);
      if (forms[j].lower != forms[j].upper) result.exact = false;
      for (std::size_t l = 0; l < kernels.size(); ++l) {
        kernels[l].back() += r * forms[j].disturbance[l] / factorial;
      }
    }
    weight = next;
    factorial *= Rational(static_cast<long>(k + 1));
  }

  for (std::size_t l = 0; l < kernels.size(); ++l) {
    const DisturbanceSpec& w = spec_->disturbances[static_cast<std::size_t>(dependencies.disturbances[l])];
    const Rational middle = (w.lower + w.upper) / 2;
    const Rational radius = (w.upper - w.lower) / 2;
    Rational integral = 0;
    Rational power = tau;
    for (std::size_t k = 0; k < kernels[l].size(); ++k, power *= tau) {
      integral += kernels[l][k] * power / Rational(static_cast<long>(k + 1));
    }
    const AbsoluteIntegral absolute = integral_of_absolute(kernels[l], tau);
    result.lower += middle * integral - radius * absolute.value;
    result.upper += middle * integral + radius * absolute.value;
    if (!absolute.exact && radius != 0) result.exact = false;
  }
  return result;
}

}  // namespace coordreq

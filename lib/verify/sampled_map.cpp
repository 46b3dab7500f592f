#include "verify/sampled_map.hpp"

#include <algorithm>
#include <utility>

#include "expression/evaluate.hpp"
#include "verify/multinomial.hpp"
#include "verify/switching_integral.hpp"

namespace coordreq {
namespace {

using Matrix = std::vector<std::vector<Rational>>;

bool stays_put(const ProblemSpec& spec, std::size_t state) {
  const Program& equation = spec.dynamics.equations[state];
  const Program::Node& last = equation.nodes.back();
  return last.op == Operator::constant && equation.constants[last.a] == 0;
}

bool is_parameter(const ProblemSpec& spec, std::size_t state) {
  return spec.states[state].discrete && (spec.dynamics.time == Time::discrete || stays_put(spec, state));
}

/// The equations of the moving states, each a Multinomial in moving states and disturbances.
std::vector<Multinomial> multiplied_out(const ProblemSpec& spec, const Influences& influences,
                                        const std::vector<std::size_t>& equations,
                                        const std::vector<Rational>& slots) {
  std::vector<Multinomial> values(spec.slot_count());
  for (const std::size_t j : influences.moving)
    values[spec.state_slot(j)] = Multinomial::variable(spec.state_slot(j));
  for (const std::size_t l : influences.disturbances)
    values[spec.disturbance_slot(l)] = Multinomial::variable(spec.disturbance_slot(l));
  for (const std::size_t j : influences.parameters)
    values[spec.state_slot(j)] = Multinomial::point(slots[spec.state_slot(j)]);
  for (const std::size_t j : influences.inputs)
    values[spec.input_slot(j)] = Multinomial::point(slots[spec.input_slot(j)]);
  std::vector<Multinomial> result;
  for (const std::size_t i : equations) {
    Evaluator<Multinomial> evaluator(spec.dynamics.equations[i]);
    result.push_back(evaluator.number(values));
  }
  return result;
}

bool solvable(const std::vector<Multinomial>& equations) {
  return std::all_of(equations.begin(), equations.end(), [](const Multinomial& equation) {
    return equation.is_affine() && equation.constant.total && equation.constant.bounded;
  });
}

std::optional<SampledMap> next_value(const ProblemSpec& spec, const Influences& influences, std::size_t state,
                                     const std::vector<Rational>& slots) {
  const std::vector<Multinomial> equation = multiplied_out(spec, influences, {state}, slots);
  if (!solvable(equation)) return std::nullopt;
  const Multinomial& next = equation.front();
  SampledMap map{.lower = next.constant.lower, .upper = next.constant.upper};
  map.exact = map.lower == map.upper;
  for (const std::size_t j : influences.moving) map.coefficient.push_back(next.slope(spec.state_slot(j)));
  for (const std::size_t l : influences.disturbances) {
    const Rational slope = next.slope(spec.disturbance_slot(l));
    const DisturbanceSpec& w = spec.disturbances[l];
    map.lower += slope * (slope > 0 ? w.lower : w.upper);
    map.upper += slope * (slope > 0 ? w.upper : w.lower);
  }
  return map;
}

/// Positions that `start` depends on for these coefficients, `start` included.
std::vector<bool> reached_from(std::size_t start, const Matrix& a) {
  std::vector<bool> reached(a.size(), false);
  std::vector<std::size_t> pending = {start};
  while (!pending.empty()) {
    const std::size_t i = pending.back();
    pending.pop_back();
    if (reached[i]) continue;
    reached[i] = true;
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (a[i][j] != 0) pending.push_back(j);
    }
  }
  return reached;
}

Matrix product(const Matrix& a, const Matrix& b) {
  const std::size_t n = a.size();
  Matrix result(n, std::vector<Rational>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      if (a[i][k] == 0) continue;
      for (std::size_t j = 0; j < n; ++j) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

bool is_zero(const Matrix& a) {
  for (const auto& row : a) {
    if (std::any_of(row.begin(), row.end(), [](const Rational& q) { return q != 0; })) return false;
  }
  return true;
}

/// I, A, A^2, ... up to the last that is not zero; empty if A is not nilpotent.
std::vector<Matrix> powers_of(const Matrix& a) {
  Matrix power(a.size(), std::vector<Rational>(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i) power[i][i] = 1;
  std::vector<Matrix> powers;
  while (!is_zero(power)) {
    if (powers.size() > a.size()) return {};
    powers.push_back(power);
    power = product(power, a);
  }
  return powers;
}

Matrix state_matrix(const ProblemSpec& spec, const Influences& influences,
                    const std::vector<Multinomial>& equations) {
  Matrix a;
  for (const Multinomial& equation : equations) {
    std::vector<Rational>& row = a.emplace_back();
    for (const std::size_t j : influences.moving) row.push_back(equation.slope(spec.state_slot(j)));
  }
  return a;
}

/// Rows and columns of what is not reached become zero: they have no part in the solution.
void forget_unreached(Matrix& a, const std::vector<bool>& reached) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (!reached[i] || !reached[j]) a[i][j] = 0;
    }
  }
}

/// Coefficients of s^0, s^1, ... of entry (i, l) of exp(A s) B.
std::vector<Rational> kernel(const std::vector<Matrix>& powers, std::size_t i,
                             const std::vector<Rational>& column) {
  std::vector<Rational> result;
  Rational factorial = 1;
  for (std::size_t k = 0; k < powers.size(); ++k) {
    if (k > 0) factorial *= Rational(static_cast<long>(k));
    Rational sum = 0;
    for (std::size_t j = 0; j < column.size(); ++j) sum += powers[k][i][j] * column[j];
    result.emplace_back(sum / factorial);
  }
  return result;
}

void add_disturbance(SampledMap& map, const DisturbanceSpec& w, const std::vector<Rational>& g,
                     const Rational& tau) {
  const SwitchingIntegral integral = integrate_switching(g, tau);
  const Rational middle = (w.lower + w.upper) / 2;
  const Rational radius = (w.upper - w.lower) / 2;
  map.lower += middle * integral.plain - radius * integral.absolute;
  map.upper += middle * integral.plain + radius * integral.absolute;
  if (!integral.exact && radius != 0) map.exact = false;
}

std::optional<SampledMap> flow_after_period(const ProblemSpec& spec, const Influences& influences,
                                            std::size_t state, const std::vector<Rational>& slots) {
  const auto place = std::find(influences.moving.begin(), influences.moving.end(), state);
  if (place == influences.moving.end()) {
    const Rational& value = slots[spec.state_slot(state)];  // a parameter stays what it is
    return SampledMap{
        .coefficient = std::vector<Rational>(influences.moving.size()), .lower = value, .upper = value};
  }
  for (const std::size_t j : influences.moving) {
    if (spec.states[j].below == Outside::stop || spec.states[j].above == Outside::stop) return std::nullopt;
  }
  const std::vector<Multinomial> equations = multiplied_out(spec, influences, influences.moving, slots);
  if (!solvable(equations)) return std::nullopt;
  const auto i = static_cast<std::size_t>(place - influences.moving.begin());
  Matrix a = state_matrix(spec, influences, equations);
  forget_unreached(a, reached_from(i, a));
  const std::vector<Matrix> powers = powers_of(a);
  if (powers.empty()) return std::nullopt;

  const Rational& tau = spec.dynamics.period;
  SampledMap map{.coefficient = std::vector<Rational>(equations.size()), .lower = 0, .upper = 0};
  Rational weight = 1;  // tau^k / k!
  for (std::size_t k = 0; k < powers.size(); ++k) {
    const Rational next = weight * tau / Rational(static_cast<long>(k + 1));
    for (std::size_t j = 0; j < equations.size(); ++j) {
      const Rational& entry = powers[k][i][j];
      const RationalInterval& drift = equations[j].constant;
      map.coefficient[j] += entry * weight;
      map.lower += entry * next * (entry > 0 ? drift.lower : drift.upper);
      map.upper += entry * next * (entry > 0 ? drift.upper : drift.lower);
      if (entry != 0 && drift.lower != drift.upper) map.exact = false;
    }
    weight = next;
  }
  for (const std::size_t l : influences.disturbances) {
    std::vector<Rational> column;
    for (const Multinomial& equation : equations) column.push_back(equation.slope(spec.disturbance_slot(l)));
    add_disturbance(map, spec.disturbances[l], kernel(powers, i, column), tau);
  }
  return map;
}

}  // namespace

Influences influences_on(const ProblemSpec& spec, std::size_t state) {
  std::vector<bool> seen(spec.slot_count(), false);
  std::vector<std::size_t> pending = {state};
  const bool flows = spec.dynamics.time == Time::continuous;
  if (flows) seen[spec.state_slot(state)] = true;
  while (!pending.empty()) {
    const Program& equation = spec.dynamics.equations[pending.back()];
    pending.pop_back();
    for (const std::uint32_t slot : equation.variables()) {
      if (!seen[slot] && flows && slot < spec.states.size()) pending.push_back(slot);
      seen[slot] = true;
    }
  }
  Influences result;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (seen[spec.state_slot(i)]) (is_parameter(spec, i) ? result.parameters : result.moving).push_back(i);
  }
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    if (seen[spec.input_slot(i)]) result.inputs.push_back(i);
  }
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i) {
    if (seen[spec.disturbance_slot(i)]) result.disturbances.push_back(i);
  }
  return result;
}

std::optional<SampledMap> sampled_map(const ProblemSpec& spec, const Influences& influences,
                                      std::size_t state, const std::vector<Rational>& slots) {
  return spec.dynamics.time == Time::discrete ? next_value(spec, influences, state, slots)
                                              : flow_after_period(spec, influences, state, slots);
}

}  // namespace coordreq

#include "verify/sampled_map.hpp"

#include <algorithm>
#include <utility>

#include "expression/evaluate.hpp"
#include "verify/multinomial.hpp"
#include "verify/piece_choices.hpp"
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

/// x' = A x + c + B w of the moving states, solved by the finite series of exp(A t).
struct LinearFlow {
  std::size_t row;                     ///< of the state asked for
  std::vector<Multinomial> equations;  ///< c and B
  std::vector<Matrix> powers;          ///< I, A, A^2, ..., as far as the state depends on them
};

std::optional<LinearFlow> linear_flow(const ProblemSpec& spec, const Influences& influences, std::size_t row,
                                      const std::vector<Rational>& slots) {
  if (has_stops(spec, influences) || jumps_on_the_way(spec, influences)) return std::nullopt;
  LinearFlow flow{.row = row, .equations = multiplied_out(spec, influences, influences.moving, slots)};
  if (!solvable(flow.equations)) return std::nullopt;
  Matrix a = state_matrix(spec, influences, flow.equations);
  forget_unreached(a, reached_from(row, a));
  flow.powers = powers_of(a);
  if (flow.powers.empty()) return std::nullopt;
  return flow;
}

std::vector<Rational> kernel_of(const ProblemSpec& spec, const LinearFlow& flow, std::size_t disturbance) {
  std::vector<Rational> column;
  for (const Multinomial& equation : flow.equations)
    column.push_back(equation.slope(spec.disturbance_slot(disturbance)));
  return kernel(flow.powers, flow.row, column);
}

/// Where the state is among the moving ones; nothing for a parameter.
std::optional<std::size_t> row_of(const Influences& influences, std::size_t state) {
  const auto place = std::find(influences.moving.begin(), influences.moving.end(), state);
  if (place == influences.moving.end()) return std::nullopt;
  return static_cast<std::size_t>(place - influences.moving.begin());
}

std::optional<SampledMap> flow_after_period(const ProblemSpec& spec, const Influences& influences,
                                            std::size_t state, const std::vector<Rational>& slots) {
  const std::optional<std::size_t> row = row_of(influences, state);
  if (!row) {
    const Rational& value = slots[spec.state_slot(state)];  // a parameter stays what it is
    return SampledMap{
        .coefficient = std::vector<Rational>(influences.moving.size()), .lower = value, .upper = value};
  }
  const std::optional<LinearFlow> flow = linear_flow(spec, influences, *row, slots);
  if (!flow) return std::nullopt;
  const Rational& tau = spec.dynamics.period;
  SampledMap map{.coefficient = std::vector<Rational>(influences.moving.size()), .lower = 0, .upper = 0};
  Rational weight = 1;  // tau^k / k!
  for (std::size_t k = 0; k < flow->powers.size(); ++k) {
    const Rational next = weight * tau / Rational(static_cast<long>(k + 1));
    for (std::size_t j = 0; j < influences.moving.size(); ++j) {
      const Rational& entry = flow->powers[k][*row][j];
      const RationalInterval& drift = flow->equations[j].constant;
      map.coefficient[j] += entry * weight;
      map.lower += entry * next * (entry > 0 ? drift.lower : drift.upper);
      map.upper += entry * next * (entry > 0 ? drift.upper : drift.lower);
      if (entry != 0 && drift.lower != drift.upper) map.exact = false;
    }
    weight = next;
  }
  for (const std::size_t l : influences.disturbances)
    add_disturbance(map, spec.disturbances[l], kernel_of(spec, *flow, l), tau);
  return map;
}

/// Adds factor * (integral of g from 0 to t).
void add_integral(Polynomial& sum, const std::vector<Rational>& g, const Rational& factor) {
  for (std::size_t k = 0; k < g.size(); ++k) sum[k + 1] += factor * g[k] / Rational(static_cast<long>(k + 1));
}

/// @param constant both choices of a disturbance that does not change
void add_disturbance(TimedMap& map, std::vector<Polynomial>& constant, const DisturbanceSpec& w,
                     std::vector<Rational> g, const Rational& tau) {
  const Rational middle = (w.lower + w.upper) / 2;
  const Rational radius = (w.upper - w.lower) / 2;
  const int sign = sign_on(g, tau);
  add_integral(map.lower, g, middle);
  add_integral(map.upper, g, middle);
  for (const std::size_t end : {0U, 1U}) {
    const bool greatest = (end == 1) == (sign >= 0);
    add_integral(constant[end], g, greatest ? w.upper : w.lower);
  }
  if (sign == 0 && radius != 0) map.exact = false;
  for (Rational& term : g) {
    if (sign == 0 ? term < 0 : sign < 0) term = -term;
  }
  add_integral(map.lower, g, -radius);
  add_integral(map.upper, g, radius);
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

std::optional<TimedMap> timed_map(const ProblemSpec& spec, const Influences& influences, std::size_t state,
                                  const std::vector<Rational>& slots) {
  if (spec.dynamics.time == Time::discrete) return std::nullopt;
  const std::size_t moving = influences.moving.size();
  const std::optional<std::size_t> row = row_of(influences, state);
  if (!row) {
    const Polynomial value = {slots[spec.state_slot(state)]};
    return TimedMap{std::vector<Polynomial>(moving, {0}), value, value, {value}};
  }
  const std::optional<LinearFlow> flow = linear_flow(spec, influences, *row, slots);
  if (!flow) return std::nullopt;
  const Polynomial zero(flow->powers.size() + 1);
  TimedMap map{std::vector<Polynomial>(moving, zero), zero, zero, {}};
  bool known = true;
  Rational factorial = 1;
  for (std::size_t k = 0; k < flow->powers.size(); ++k) {
    const Rational next = factorial * Rational(static_cast<long>(k + 1));
    for (std::size_t j = 0; j < moving; ++j) {
      const Rational& entry = flow->powers[k][*row][j];
      const RationalInterval& drift = flow->equations[j].constant;
      map.coefficient[j][k] = entry / factorial;
      map.lower[k + 1] += entry / next * (entry > 0 ? drift.lower : drift.upper);
      map.upper[k + 1] += entry / next * (entry > 0 ? drift.upper : drift.lower);
      known = known && (entry == 0 || drift.lower == drift.upper);
    }
    factorial = next;
  }
  std::vector<Polynomial> constant(2, map.lower);
  for (const std::size_t l : influences.disturbances) {
    add_disturbance(map, constant, spec.disturbances[l], kernel_of(spec, *flow, l), spec.dynamics.period);
  }
  map.exact = map.exact && known;
  if (known) map.attained = std::move(constant);
  return map;
}

}  // namespace coordreq

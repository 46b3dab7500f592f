#include "verify/sampled_map.hpp"

#include <flint/fmpq_mat.h>

#include <algorithm>
#include <utility>

#include "spec/system_spec.hpp"
#include "verify/affine_form.hpp"
#include "verify/arb.hpp"
#include "verify/piece_choices.hpp"

namespace coordreq {
namespace {

bool stays_put(const SystemSpec& spec, std::size_t state) {
  const Program& equation = spec.dynamics.equations[state];
  const Program::Node& last = equation.nodes.back();
  return last.op == Operator::constant && equation.constants[last.a] == 0;
}

bool is_parameter(const SystemSpec& spec, std::size_t state) {
  return spec.states[state].discrete && (spec.dynamics.time == Time::discrete || stays_put(spec, state));
}

/// Moving states, then disturbances.
std::vector<std::uint32_t> variables_of(const SystemSpec& spec, const Influences& influences) {
  std::vector<std::uint32_t> slots;
  for (const std::size_t j : influences.moving) slots.push_back(spec.state_slot(j));
  for (const std::size_t l : influences.disturbances) slots.push_back(spec.disturbance_slot(l));
  return slots;
}

std::optional<SampledMap> next_value(const SystemSpec& spec, const Influences& influences, std::size_t state,
                                     const std::vector<Rational>& slots) {
  const std::optional<ExactForm> next =
      affine_form(spec.dynamics.equations[state], variables_of(spec, influences), slots);
  if (!next) return std::nullopt;
  const std::size_t n = influences.moving.size();
  SampledMap map{
      .coefficient = {}, .stopped = {}, .rate = {}, .lower = next->constant, .upper = next->constant};
  map.coefficient.assign(next->slope.begin(), next->slope.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t l = 0; l < influences.disturbances.size(); ++l) {
    const Rational& slope = next->slope[n + l];
    const DisturbanceSpec& w = spec.disturbances[influences.disturbances[l]];
    map.lower += slope * (slope > 0 ? w.lower : w.upper);
    map.upper += slope * (slope > 0 ? w.upper : w.lower);
  }
  return map;
}

class RationalMatrix {
 public:
  RationalMatrix(std::size_t rows, std::size_t columns) {
    fmpq_mat_init(matrix_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  RationalMatrix(const RationalMatrix&) = delete;
  RationalMatrix& operator=(const RationalMatrix&) = delete;
  ~RationalMatrix() { fmpq_mat_clear(matrix_); }

  [[nodiscard]] fmpq_mat_struct* get() { return matrix_; }
  void set(std::size_t i, std::size_t j, const Rational& value) {
    fmpq_set(entry(i, j), FlintRational(value).get());
  }
  [[nodiscard]] Rational at(std::size_t i, std::size_t j) const {
    Rational value;
    fmpq_get_mpq(value.get_mpq_t(), entry(i, j));
    return value;
  }
  /// A power of it is 0.
  [[nodiscard]] bool is_nilpotent() const {
    fmpq_poly_t characteristic;
    fmpq_poly_init(characteristic);
    fmpq_mat_charpoly(characteristic, matrix_);
    const slong degree = fmpq_poly_degree(characteristic);
    bool nilpotent = true;
    for (slong k = 0; k < degree; ++k)
      nilpotent = nilpotent && fmpz_is_zero(fmpq_poly_numref(characteristic) + k) != 0;
    fmpq_poly_clear(characteristic);
    return nilpotent;
  }

 private:
  [[nodiscard]] fmpq* entry(std::size_t i, std::size_t j) const {
    return fmpq_mat_entry(matrix_, static_cast<slong>(i), static_cast<slong>(j));
  }

  fmpq_mat_t matrix_;
};

/// Positions that `start` depends on, `start` included.
std::vector<bool> reached_from(std::size_t start, const std::vector<ExactForm>& equations) {
  std::vector<bool> reached(equations.size(), false);
  std::vector<std::size_t> pending = {start};
  while (!pending.empty()) {
    const std::size_t i = pending.back();
    pending.pop_back();
    if (reached[i]) continue;
    reached[i] = true;
    for (std::size_t j = 0; j < equations.size(); ++j) {
      if (equations[i].slope[j] != 0) pending.push_back(j);
    }
  }
  return reached;
}

/// One state of x' = A x + c + B w with A nilpotent, as far as the state depends on it:
/// x(t) = coefficient(t) x + drift(t) + the integral of kernel(s) w(t - s).
struct LinearFlow {
  std::vector<TimePolynomial> coefficient;  ///< one for each moving state
  TimePolynomial drift;
  std::vector<TimePolynomial> kernel;  ///< one for each disturbance
};

/// By rows of A^k: `row` of exp(A t) is sum_k row(A^k) t^k / k!.
std::optional<LinearFlow> solved(const std::vector<ExactForm>& equations, std::size_t row,
                                 std::size_t disturbances) {
  const std::size_t n = equations.size();
  const std::vector<bool> reached = reached_from(row, equations);
  RationalMatrix a(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (reached[i] && reached[j]) a.set(i, j, equations[i].slope[j]);
    }
  }
  if (!a.is_nilpotent()) return std::nullopt;
  LinearFlow flow{.coefficient = std::vector<TimePolynomial>(n),
                  .drift = {},
                  .kernel = std::vector<TimePolynomial>(disturbances)};
  RationalMatrix power(1, n);
  power.set(0, row, 1);
  Rational factorial = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const auto exponent = static_cast<slong>(k);
    Rational drift = 0;
    std::vector<Rational> kernel(disturbances);
    for (std::size_t j = 0; j < n; ++j) {
      const Rational entry = power.at(0, j) / factorial;
      flow.coefficient[j].set(exponent, entry);
      drift += entry * equations[j].constant;
      for (std::size_t l = 0; l < disturbances; ++l) kernel[l] += entry * equations[j].slope[n + l];
    }
    flow.drift.set(exponent, drift);
    for (std::size_t l = 0; l < disturbances; ++l) flow.kernel[l].set(exponent, kernel[l]);
    fmpq_mat_mul(power.get(), power.get(), a.get());
    factorial *= Rational(static_cast<long>(k + 1));
  }
  flow.drift = flow.drift.integral();
  return flow;
}

/// The equations of the moving states, if all are affine.
std::optional<std::vector<ExactForm>> equations_of(const SystemSpec& spec, const Influences& influences,
                                                   const std::vector<Rational>& slots) {
  std::vector<ExactForm> equations;
  for (const std::size_t i : influences.moving) {
    std::optional<ExactForm> equation =
        affine_form(spec.dynamics.equations[i], variables_of(spec, influences), slots);
    if (!equation) return std::nullopt;
    equations.push_back(std::move(*equation));
  }
  return equations;
}

std::optional<LinearFlow> linear_flow(const SystemSpec& spec, const Influences& influences, std::size_t state,
                                      const std::vector<Rational>& slots) {
  const std::optional<std::size_t> row = row_of(influences, state);
  if (!row) {
    LinearFlow still{.coefficient = std::vector<TimePolynomial>(influences.moving.size()),
                     .drift = {slots[spec.state_slot(state)]},
                     .kernel = std::vector<TimePolynomial>(influences.disturbances.size())};
    return still;
  }
  if (has_stops(spec, influences) || !seams_that_jump(spec, influences).empty()) return std::nullopt;
  const std::optional<std::vector<ExactForm>> equations = equations_of(spec, influences, slots);
  if (!equations) return std::nullopt;
  return solved(*equations, *row, influences.disturbances.size());
}

/// Adds all values that a disturbance can bring about, if it acts through a kernel.
void add_values(SampledMap& map, const DisturbanceSpec& w, const TimePolynomial& kernel,
                const Rational& tau) {
  const Rational plain = kernel.integral().at(tau);
  const SwitchingIntegral switching = integrate_switching(kernel, tau);
  const Rational middle = (w.lower + w.upper) / 2;
  const Rational radius = (w.upper - w.lower) / 2;
  map.lower += middle * plain - radius * switching.value;
  map.upper += middle * plain + radius * switching.value;
  if (!switching.exact && radius != 0) map.exact = false;
}

/// A flow in which some states are stopped. These integrate what is constant or a disturbance, so that v
/// moves as if there was no limit until it is held for good; x_i responds to what v moves as to what v is.
class StoppedFlow {
 public:
  StoppedFlow(const SystemSpec& spec, const Influences& influences, std::vector<ExactForm> equations)
      : spec_(spec), influences_(influences), equations_(std::move(equations)) {}

  /// @param row of x_i
  [[nodiscard]] std::optional<SampledMap> after_period(std::size_t row) const {
    const std::size_t n = equations_.size();
    for (std::size_t j = 0; j < n; ++j) {
      const auto begin = equations_[j].slope.begin();
      const bool is_integrator = std::all_of(begin, begin + static_cast<std::ptrdiff_t>(n),
                                             [](const Rational& slope) { return slope == 0; });
      if (stops(j) && !is_integrator) return std::nullopt;
    }
    const std::optional<LinearFlow> flow = solved(equations_, row, influences_.disturbances.size());
    if (!flow) return std::nullopt;
    const Rational& tau = spec_.dynamics.period;
    SampledMap map{.coefficient = std::vector<Rational>(n), .stopped = {}, .rate = rate_of(row)};
    for (std::size_t j = 0; j < n; ++j) {
      const TimePolynomial& response = flow->coefficient[j];
      if (!stops(j)) {
        map.coefficient[j] = response.at(tau);
        map.lower += equations_[j].constant * response.integral().at(tau);
        continue;
      }
      std::optional<StoppedTerm> term = term_of(j, row, response);
      if (!term) return std::nullopt;
      map.stopped.push_back(std::move(*term));
    }
    map.upper = map.lower;
    if (!add_disturbances(*flow, map)) return std::nullopt;
    return map;
  }

 private:
  [[nodiscard]] bool stops(std::size_t j) const {
    return spec_.states[influences_.moving[j]].has(Outside::stop);
  }

  [[nodiscard]] SampledMap::Rate rate_of(std::size_t j) const {
    const auto begin = equations_[j].slope.begin();
    SampledMap::Rate rate{.slope = {begin, begin + static_cast<std::ptrdiff_t>(equations_.size())},
                          .slowest = equations_[j].constant,
                          .fastest = equations_[j].constant};
    for (std::size_t l = 0; l < influences_.disturbances.size(); ++l) {
      const Rational& slope = equations_[j].slope[equations_.size() + l];
      const DisturbanceSpec& w = spec_.disturbances[influences_.disturbances[l]];
      rate.slowest += std::min(Rational(slope * w.lower), Rational(slope * w.upper));
      rate.fastest += std::max(Rational(slope * w.lower), Rational(slope * w.upper));
    }
    return rate;
  }

  [[nodiscard]] std::optional<StoppedTerm> term_of(std::size_t j, std::size_t row,
                                                   const TimePolynomial& response) const {
    const SampledMap::Rate rate = rate_of(j);
    StoppedTerm term{
        .moving = j, .rises = true, .response = response, .slowest = rate.slowest, .fastest = rate.fastest};
    if (j == row) return term;
    // How x_i changes with v at any time: with one sign, or it is not monotone.
    const TimePolynomial kernel = response.derivative();
    const Rational plain = kernel.integral().at(spec_.dynamics.period);
    const SwitchingIntegral switching = integrate_switching(kernel, spec_.dynamics.period);
    if (!switching.exact || switching.value != abs(plain)) return std::nullopt;
    term.rises = plain > 0;
    return term;
  }

  /// @returns false if one acts on a state that is stopped and on others
  [[nodiscard]] bool add_disturbances(const LinearFlow& flow, SampledMap& map) const {
    for (std::size_t l = 0; l < influences_.disturbances.size(); ++l) {
      std::size_t all = 0;
      bool on_stopped = false;
      for (std::size_t j = 0; j < equations_.size(); ++j) {
        if (equations_[j].slope[equations_.size() + l] == 0) continue;
        ++all;
        on_stopped = on_stopped || stops(j);
      }
      if (on_stopped && all > 1) return false;
      if (!on_stopped)
        add_values(map, spec_.disturbances[influences_.disturbances[l]], flow.kernel[l],
                   spec_.dynamics.period);
    }
    return true;
  }

  const SystemSpec& spec_;
  const Influences& influences_;
  std::vector<ExactForm> equations_;
};

std::optional<SampledMap> flow_after_period(const SystemSpec& spec, const Influences& influences,
                                            std::size_t state, const std::vector<Rational>& slots) {
  const std::optional<std::size_t> row = row_of(influences, state);
  if (row && has_stops(spec, influences)) {
    if (!seams_that_jump(spec, influences).empty()) return std::nullopt;
    std::optional<std::vector<ExactForm>> equations = equations_of(spec, influences, slots);
    if (!equations) return std::nullopt;
    return StoppedFlow(spec, influences, std::move(*equations)).after_period(*row);
  }
  const std::optional<LinearFlow> flow = linear_flow(spec, influences, state, slots);
  if (!flow) return std::nullopt;
  const Rational& tau = spec.dynamics.period;
  SampledMap map{.coefficient = {},
                 .stopped = {},
                 .rate = {},
                 .lower = flow->drift.at(tau),
                 .upper = flow->drift.at(tau)};
  for (const TimePolynomial& coefficient : flow->coefficient) map.coefficient.push_back(coefficient.at(tau));
  for (std::size_t l = 0; l < influences.disturbances.size(); ++l) {
    add_values(map, spec.disturbances[influences.disturbances[l]], flow->kernel[l], tau);
  }
  return map;
}

/// @param constant both choices of a disturbance that does not change
void add_disturbance(TimedMap& map, std::vector<TimePolynomial>& constant, const DisturbanceSpec& w,
                     const TimePolynomial& kernel, const Rational& tau) {
  const Rational middle = (w.lower + w.upper) / 2;
  const Rational radius = (w.upper - w.lower) / 2;
  const int sign = sign_on(kernel, tau);
  const TimePolynomial plain = kernel.integral();
  for (const std::size_t end : {0U, 1U}) {
    const bool greatest = (end == 1) == (sign >= 0);
    constant[end] += plain * (greatest ? w.upper : w.lower);
  }
  if (sign == 0 && radius != 0) map.exact = false;
  TimePolynomial size = kernel * Rational(sign < 0 ? -1 : 1);
  for (slong k = 0; sign == 0 && k <= fmpq_poly_degree(kernel.get()); ++k) size.set(k, abs(kernel[k]));
  map.lower += plain * middle;
  map.lower += size.integral() * Rational(-radius);
  map.upper += plain * middle;
  map.upper += size.integral() * radius;
}

}  // namespace

Influences influences_on(const SystemSpec& spec, std::size_t state) {
  std::vector<bool> seen(spec.slot_count(), false);
  const UpdateSpec* const update = spec.dynamics.update(state);
  std::vector<std::size_t> pending;
  if (update == nullptr) pending.push_back(state);
  const bool flows = spec.dynamics.time == Time::continuous && update == nullptr;
  if (flows || (update != nullptr && spec.abstraction.between_samples)) seen[spec.state_slot(state)] = true;
  if (update != nullptr) {
    for (const std::uint32_t slot : update->variables()) seen[slot] = true;
  }
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
    const bool is_point = is_parameter(spec, i) || (update != nullptr && spec.states[i].discrete);
    if (seen[spec.state_slot(i)]) (is_point ? result.parameters : result.moving).push_back(i);
  }
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    if (seen[spec.input_slot(i)]) result.inputs.push_back(i);
  }
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i) {
    if (seen[spec.disturbance_slot(i)]) result.disturbances.push_back(i);
  }
  return result;
}

std::optional<std::size_t> row_of(const Influences& influences, std::size_t state) {
  const auto found = std::find(influences.moving.begin(), influences.moving.end(), state);
  if (found == influences.moving.end()) return std::nullopt;
  return static_cast<std::size_t>(found - influences.moving.begin());
}

std::optional<SampledMap> sampled_map(const SystemSpec& spec, const Influences& influences, std::size_t state,
                                      const std::vector<Rational>& slots) {
  return spec.dynamics.time == Time::discrete ? next_value(spec, influences, state, slots)
                                              : flow_after_period(spec, influences, state, slots);
}

std::optional<TimedMap> timed_map(const SystemSpec& spec, const Influences& influences, std::size_t state,
                                  const std::vector<Rational>& slots) {
  if (spec.dynamics.time == Time::discrete) return std::nullopt;
  std::optional<LinearFlow> flow = linear_flow(spec, influences, state, slots);
  if (!flow) return std::nullopt;
  TimedMap map{std::move(flow->coefficient), flow->drift, flow->drift, {flow->drift, flow->drift}};
  for (std::size_t l = 0; l < influences.disturbances.size(); ++l) {
    add_disturbance(map, map.attained, spec.disturbances[influences.disturbances[l]], flow->kernel[l],
                    spec.dynamics.period);
  }
  return map;
}

}  // namespace coordreq

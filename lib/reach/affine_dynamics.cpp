#include "reach/affine_dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "expression/evaluate.hpp"
#include "expression/place.hpp"
#include "reach/polynomial.hpp"

namespace coordreq {
namespace {

bool is_constant_zero(const Program& program) {
  return program.nodes.back().op == Operator::constant && program.constants[program.nodes.back().a] == 0;
}

/// A discrete state is put in value by value where it does not move between samples; in discrete time always.
bool is_parameter(const ProblemSpec& spec, std::size_t state) {
  if (!spec.states[state].discrete) return false;
  return spec.dynamics.time == Time::discrete || is_constant_zero(spec.dynamics.equations[state]);
}

/// Marks every variable of the equations that `state` depends on: its own equation in discrete time, the
/// transitive closure in continuous time.
std::vector<bool> used_slots(const ProblemSpec& spec, std::size_t state) {
  std::vector<bool> used(spec.slot_count(), false);
  std::vector<std::size_t> pending = {state};
  if (spec.dynamics.time == Time::continuous) used[state] = true;
  while (!pending.empty()) {
    const std::size_t equation = pending.back();
    pending.pop_back();
    for (const std::uint32_t slot : spec.dynamics.equations[equation].variables()) {
      if (used[slot]) continue;
      used[slot] = true;
      if (spec.dynamics.time == Time::continuous && slot < spec.states.size()) pending.push_back(slot);
    }
  }
  return used;
}

Dependencies find_dependencies(const ProblemSpec& spec, std::size_t state) {
  const std::vector<bool> used = used_slots(spec, state);
  Dependencies result;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!used[spec.state_slot(i)]) continue;
    (is_parameter(spec, i) ? result.parameters : result.moving).push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    if (used[spec.input_slot(i)]) result.inputs.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i) {
    if (used[spec.disturbance_slot(i)]) result.disturbances.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

}  // namespace

AffineDynamics::AffineDynamics(const ProblemSpec& spec) : spec_(&spec) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) dependencies_.push_back(find_dependencies(spec, i));
}

std::string AffineDynamics::place(const Dependencies& dependencies,
                                  const std::vector<Rational>& slots) const {
  std::string text;
  const auto append = [&](const std::string& name, std::uint32_t slot) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, to_text(slots[slot]));
  };
  for (const std::int32_t i : dependencies.parameters) {
    const auto index = static_cast<std::size_t>(i);
    append(spec_->states[index].name, spec_->state_slot(index));
  }
  for (const std::int32_t i : dependencies.inputs) {
    const auto index = static_cast<std::size_t>(i);
    append(spec_->inputs[index].name, spec_->input_slot(index));
  }
  return text.empty() ? "" : " at " + text;
}

std::optional<AffineDynamics::AffineForm> AffineDynamics::affine_form(
    std::size_t equation, const Dependencies& dependencies, const std::vector<Rational>& slots) const {
  const std::string where = "/dynamics/equations/" + spec_->states[equation].name;
  std::vector<Polynomial> values(spec_->slot_count());
  const auto slot_of = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  for (const std::int32_t i : dependencies.moving) {
    const std::uint32_t slot = spec_->state_slot(slot_of(i));
    values[slot] = Polynomial::variable(slot);
  }
  for (const std::int32_t i : dependencies.disturbances) {
    const std::uint32_t slot = spec_->disturbance_slot(slot_of(i));
    values[slot] = Polynomial::variable(slot);
  }
  for (const std::int32_t i : dependencies.parameters) {
    values[spec_->state_slot(slot_of(i))] = Polynomial::value(slots[spec_->state_slot(slot_of(i))]);
  }
  for (const std::int32_t i : dependencies.inputs) {
    values[spec_->input_slot(slot_of(i))] = Polynomial::value(slots[spec_->input_slot(slot_of(i))]);
  }

  Evaluator<Polynomial> evaluator(spec_->dynamics.equations[equation]);
  const Polynomial polynomial = evaluator.number(values);
  if (polynomial.known && (!polynomial.constant.total || !polynomial.constant.bounded)) {
    throw SpecError(
        fmt::format("the equation of '{}', {}, is not defined or not finite{}", spec_->states[equation].name,
                    quoted(spec_->dynamics.equations[equation].text), place(dependencies, slots)),
        where);
  }
  if (!polynomial.known || polynomial.degree() > 1) return std::nullopt;
  AffineForm form{.state = std::vector<Rational>(dependencies.moving.size()),
                  .disturbance = std::vector<Rational>(dependencies.disturbances.size()),
                  .lower = polynomial.constant.lower,
                  .upper = polynomial.constant.upper};
  const auto coefficient_of = [&](std::uint32_t slot) {
    const auto found = polynomial.terms.find({{slot, 1}});
    return found == polynomial.terms.end() ? Rational(0) : found->second;
  };
  for (std::size_t j = 0; j < dependencies.moving.size(); ++j) {
    form.state[j] = coefficient_of(spec_->state_slot(slot_of(dependencies.moving[j])));
  }
  for (std::size_t l = 0; l < dependencies.disturbances.size(); ++l) {
    form.disturbance[l] = coefficient_of(spec_->disturbance_slot(slot_of(dependencies.disturbances[l])));
  }
  return form;
}

bool AffineDynamics::has_limit(std::size_t state) const {
  const std::vector<std::int32_t>& moving = dependencies_[state].moving;
  return std::any_of(moving.begin(), moving.end(), [&](std::int32_t j) {
    const StateSpec& one = spec_->states[static_cast<std::size_t>(j)];
    return one.below == Outside::stop || one.above == Outside::stop;
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
  const std::optional<AffineForm> found = affine_form(state, dependencies, slots);
  if (!found) return std::nullopt;
  const AffineForm& form = *found;
  SampledRow row{
      .coefficient = form.state, .lower = form.lower, .upper = form.upper, .exact = form.lower == form.upper};
  for (std::size_t l = 0; l < form.disturbance.size(); ++l) {
    const DisturbanceSpec& w = spec_->disturbances[static_cast<std::size_t>(dependencies.disturbances[l])];
    const Rational at_lower = form.disturbance[l] * w.lower;
    const Rational at_upper = form.disturbance[l] * w.upper;
    row.lower += std::min(at_lower, at_upper);
    row.upper += std::max(at_lower, at_upper);
  }
  return row;
}

}  // namespace coordreq

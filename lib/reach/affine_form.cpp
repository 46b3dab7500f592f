#include "reach/affine_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/index.hpp"
#include "expression/evaluate.hpp"
#include "expression/place.hpp"
#include "reach/polynomial.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// " at x = 1, u = 0.5"; empty without parameters and inputs.
std::string location(const SystemSpec& spec, const Dependencies& dependencies,
                     const std::vector<Rational>& slots) {
  std::string text;
  const auto append = [&](const std::string& name, std::uint32_t slot) {
    text += fmt::format("{}{} = {}", text.empty() ? " at " : ", ", name, to_text(slots[slot]));
  };
  for (const std::int32_t i : dependencies.parameters)
    append(spec.states[at(i)].name, spec.state_slot(at(i)));
  for (const std::int32_t i : dependencies.inputs) append(spec.inputs[at(i)].name, spec.input_slot(at(i)));
  return text;
}

/// The variables of the polynomials are the moving states and the disturbances.
std::vector<Polynomial> variables(const SystemSpec& spec, const Dependencies& dependencies,
                                  const std::vector<Rational>& slots) {
  std::vector<Polynomial> values(spec.slot_count());
  const auto set_variable = [&](std::uint32_t slot) { values[slot] = Polynomial::variable(slot); };
  const auto set_value = [&](std::uint32_t slot) { values[slot] = Polynomial::value(slots[slot]); };
  for (const std::int32_t i : dependencies.moving) set_variable(spec.state_slot(at(i)));
  for (const std::int32_t i : dependencies.disturbances) set_variable(spec.disturbance_slot(at(i)));
  for (const std::int32_t i : dependencies.parameters) set_value(spec.state_slot(at(i)));
  for (const std::int32_t i : dependencies.inputs) set_value(spec.input_slot(at(i)));
  return values;
}

}  // namespace

std::optional<AffineForm> affine_form(const SystemSpec& spec, std::size_t equation,
                                      const Dependencies& dependencies, const std::vector<Rational>& slots) {
  const Program& program = spec.dynamics.equations[equation];
  const Polynomial polynomial = Evaluator<Polynomial>(program).number(variables(spec, dependencies, slots));
  if (polynomial.known && (!polynomial.constant.total || !polynomial.constant.bounded)) {
    const std::string& name = spec.states[equation].name;
    throw SpecError(fmt::format("the equation of '{}', {}, is not defined or not finite{}", name,
                                in_quotes(program.text), location(spec, dependencies, slots)),
                    "/dynamics/equations/" + name);
  }
  if (!polynomial.known || polynomial.degree() > 1) return std::nullopt;
  const auto coefficient = [&](std::uint32_t slot) {
    const auto found = polynomial.terms.find({{slot, 1}});
    return found == polynomial.terms.end() ? Rational(0) : found->second;
  };
  AffineForm form{.state = RationalRow(static_cast<Eigen::Index>(dependencies.moving.size())),
                  .disturbance = RationalRow(static_cast<Eigen::Index>(dependencies.disturbances.size())),
                  .lower = polynomial.constant.lower,
                  .upper = polynomial.constant.upper};
  std::transform(dependencies.moving.begin(), dependencies.moving.end(), form.state.begin(),
                 [&](std::int32_t i) { return coefficient(spec.state_slot(at(i))); });
  std::transform(dependencies.disturbances.begin(), dependencies.disturbances.end(), form.disturbance.begin(),
                 [&](std::int32_t i) { return coefficient(spec.disturbance_slot(at(i))); });
  return form;
}

}  // namespace coordreq

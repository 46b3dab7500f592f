#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/advice.hpp"
#include "expression/evaluate.hpp"
#include "model/outside.hpp"
#include "spec/problem_spec.hpp"
#include "spec/units.hpp"

namespace coordreq {
namespace {

/// The unit of a number, as far as known.
struct Measure {
  UnitValue unit;
  std::string text;        ///< as users write it
  std::string name;        ///< of a variable
  bool is_number = false;  ///< a plain number, as sines are, although the spec does not say so
};
using Known = std::optional<Measure>;

/// By slot.
std::vector<Known> measures_of(const SystemSpec& spec) {
  std::vector<Known> all;
  const auto add = [&all](const auto& variables) {
    for (const auto& variable : variables) {
      const std::optional<UnitValue> unit = unit_value(variable.unit);
      all.push_back(unit ? Known({*unit, variable.unit, variable.name}) : Known());
    }
  };
  add(spec.states);
  add(spec.inputs);
  add(spec.disturbances);
  return all;
}

Known product(const Known& a, const Known& b, bool divides) {
  if (!a || !b) return std::nullopt;
  if (b->is_number) return a;
  if (a->is_number && !divides) return b;
  return Measure{divides ? a->unit / b->unit : a->unit * b->unit,
                 fmt::format("({}){}({})", a->text, divides ? "/" : "*", b->text), "", false};
}

Known raised(const Program& program, const Known& base, const Program::Node& exponent) {
  if (!base || exponent.op != Operator::constant) return std::nullopt;
  const Rational& value = program.constants[exponent.a];
  if (!is_integer(value) || value < 1 || value > 9) return std::nullopt;
  const auto times = static_cast<int>(nearest_double(value));
  return Measure{power(base->unit, times), fmt::format("({})^{}", base->text, times), "", base->is_number};
}

/// By node: of a sum what is known of one of its terms; nothing of constants, and of what they multiply, for
/// that may be a conversion.
std::vector<Known> measures_of_nodes(const Program& program, const std::vector<Known>& slots) {
  std::vector<Known> all(program.nodes.size());
  const auto first_known = [&](std::uint32_t a, std::uint32_t b) { return all[a] ? all[a] : all[b]; };
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Program::Node& node = program.nodes[n];
    switch (node.op) {
      case Operator::variable:
        if (node.a < slots.size()) all[n] = slots[node.a];
        break;
      case Operator::add:
      case Operator::subtract:
      case Operator::minimum:
      case Operator::maximum:
        all[n] = first_known(node.a, node.b);
        break;
      case Operator::if_else:
        all[n] = first_known(node.b, node.c);
        break;
      case Operator::multiply:
      case Operator::divide:
        all[n] = product(all[node.a], all[node.b], node.op == Operator::divide);
        break;
      case Operator::power:
        all[n] = raised(program, all[node.a], program.nodes[node.b]);
        break;
      case Operator::negate:
      case Operator::absolute:
        all[n] = all[node.a];
        break;
      case Operator::sine:
      case Operator::cosine:
      case Operator::tangent:
      case Operator::sign:
        all[n] = Measure{{}, "1", "", true};
        break;
      default:
        break;
    }
  }
  return all;
}

/// The terms of a sum.
void add_terms(const Program& program, std::uint32_t node, std::vector<std::uint32_t>& terms) {
  constexpr std::size_t kMostTerms = 1000;  // sums of sums that are stored once have more than nodes
  const Program::Node& self = program.nodes[node];
  if (terms.size() >= kMostTerms) return;
  if (self.op == Operator::negate) return add_terms(program, self.a, terms);
  if (self.op != Operator::add && self.op != Operator::subtract) return terms.push_back(node);
  add_terms(program, self.a, terms);
  add_terms(program, self.b, terms);
}

/// Terms of the derivative of a state that are not in its unit by the unit of time.
void advise_on_derivative(const SystemSpec& spec, std::size_t i, const std::vector<Known>& slots,
                          Warnings& found) {
  const StateSpec& state = spec.states[i];
  const std::optional<UnitValue> time = unit_value(spec.dynamics.unit);
  const Known& known_unit = slots[spec.state_slot(i)];
  if (!time || !known_unit) return;
  const Program& equation = spec.dynamics.equations[i];
  const std::vector<Known> nodes = measures_of_nodes(equation, slots);
  std::vector<std::uint32_t> terms;
  add_terms(equation, static_cast<std::uint32_t>(equation.nodes.size() - 1), terms);
  for (const std::uint32_t term : terms) {
    const Known& known = nodes[term];
    if (!known || known->is_number || is_same(known->unit, known_unit->unit / *time)) continue;
    found.push_back(
        {"units", spec.dynamics.pointer_of(state.name, i),
         fmt::format("{} is in {} and time in {}, so that its derivative is in {}/{}, but {} is in {}",
                     state.name, state.unit, spec.dynamics.unit, state.unit, spec.dynamics.unit,
                     known->name.empty() ? "a term of it" : known->name, known->text)});
    return;
  }
}

/// Sines of degrees, and of periodic states that do not come round when sines do.
void advise_on_turns(const SystemSpec& spec, const Program& program, const std::string& pointer,
                     const std::vector<Known>& slots, Warnings& found) {
  const std::vector<Known> nodes = measures_of_nodes(program, slots);
  std::vector<double> values(std::max(spec.slot_count(), std::size_t{1}));
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    values[spec.state_slot(i)] = nearest_double(spec.states[i].lower);
  for (std::size_t j = 0; j < spec.inputs.size(); ++j)
    values[spec.input_slot(j)] = nearest_double(spec.inputs[j].values.front());
  for (const std::uint32_t slot : program.variables())
    if (slot >= values.size()) return;
  Evaluator<double> evaluator(program);
  const auto run = [&] {
    if (program.is_condition())
      static_cast<void>(evaluator.condition(values));
    else
      static_cast<void>(evaluator.number(values));
  };
  for (const Program::Node& node : program.nodes) {
    if (node.op != Operator::sine && node.op != Operator::cosine) continue;
    const Known& argument = nodes[node.a];
    if (argument && !argument->is_number && !argument->unit.has_dimension() &&
        !is_same(argument->unit, UnitValue{})) {
      found.push_back(
          {"units", pointer,
           fmt::format("{} takes radians, but {} is in {}", spelling(node.op),
                       argument->name.empty() ? "what it is given" : argument->name, argument->text)});
      return;
    }
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      const StateSpec& state = spec.states[i];
      if (state.below != Outside::periodic) continue;
      run();
      const double before = evaluator.at(node.a);
      double& value = values[spec.state_slot(i)];
      value = nearest_double(state.upper);
      run();
      const double turns = (evaluator.at(node.a) - before) / (2 * std::numbers::pi);
      value = nearest_double(state.lower);
      constexpr double kRounding = 1e-6;
      if (!std::isfinite(turns) || std::fabs(turns - std::round(turns)) < kRounding) continue;
      found.push_back(
          {"units", pointer,
           fmt::format("{} is periodic, and over one period {} makes {:.6g} turns, no whole number: "
                       "angles are in radians",
                       state.name, spelling(node.op), std::fabs(turns))});
      return;
    }
  }
}

/// States that cross much of their domain at once; what limits hold, as speeds, may go from one to the other.
void advise_on_scale(const SystemSpec& spec, const std::vector<StateMotion>& motion, Warnings& found) {
  constexpr double kMuch = 1.0 / 3, kAll = 1.0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const StateSpec& state = spec.states[i];
    const bool is_held = traits(state.below).clamps && traits(state.above).clamps;
    if (state.discrete || motion[i].share <= (is_held ? kAll : kMuch)) continue;
    const auto amount = [](double value, const std::string& unit) {
      return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
    };
    found.push_back(
        {"scale", fmt::format("/states/{}", i),
         fmt::format(
             "{} moves by up to {} in a period of {}, and its domain is {} long: is the period what was "
             "meant, and in the unit of the equations?",
             state.name, amount(motion[i].amount, state.unit),
             amount(nearest_double(spec.dynamics.period), spec.dynamics.unit),
             amount(motion[i].amount / motion[i].share, state.unit))});
  }
}

}  // namespace

Warnings advise_on_units(const ProblemSpec& spec, const std::vector<StateMotion>& motion) {
  const std::vector<Known> slots = measures_of(spec);
  Warnings found;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.dynamics.update(i) != nullptr) continue;
    if (spec.dynamics.time == Time::continuous) advise_on_derivative(spec, i, slots, found);
    advise_on_turns(spec, spec.dynamics.equations[i], spec.dynamics.pointer_of(spec.states[i].name, i), slots,
                    found);
  }
  advise_on_turns(spec, spec.safe, "/safe", slots, found);
  if (spec.dynamics.time == Time::continuous) advise_on_scale(spec, motion, found);
  return found;
}

}  // namespace coordreq

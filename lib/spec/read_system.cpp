#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_parts.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

template <class Spec>
std::vector<std::string> names_of(const std::vector<Spec>& specs) {
  std::vector<std::string> names;
  names.reserve(specs.size());
  for (const Spec& spec : specs) names.push_back(spec.name);
  return names;
}

std::vector<std::string> state_names(const Node& root) {
  std::vector<std::string> names;
  for (const Node& state : root.elements("states")) names.push_back(state["name"].text());
  return names;
}

/// Indices of the states that an agent reads by itself, ascending.
std::vector<std::int32_t> read_sees(const Node& agent, const std::vector<std::string>& states) {
  std::vector<std::int32_t> seen;
  for (const Node& name : agent.elements("sees")) {
    const std::int32_t state = index_of_name(name, states, "a state");
    if (std::ranges::count(seen, state) > 0)
      throw SpecError("the state " + quote_text(name.text()) + " is listed twice", name.pointer());
    seen.push_back(state);
  }
  std::ranges::sort(seen);
  return seen;
}

constexpr std::int32_t kNobody = -1;

/// Gives an input to agent `agent`. @pre `owners` holds the agent that owns each input, or kNobody
void take_input(const Node& name, std::int32_t input, std::int32_t agent,
                const std::vector<AgentSpec>& agents, std::vector<std::int32_t>& owners) {
  REQUIRES(std::cmp_less(input, owners.size()) && std::ranges::all_of(owners, [agent](std::int32_t owner) {
             return kNobody <= owner && owner <= agent;
           }));
  std::int32_t& owner = owners[static_cast<std::size_t>(input)];
  if (owner == agent)
    throw SpecError("the input " + quote_text(name.text()) + " is listed twice", name.pointer());
  if (owner != kNobody) {
    throw SpecError(fmt::format("the input {} belongs to the agent {} already", quote_text(name.text()),
                                quote_text(agents[static_cast<std::size_t>(owner)].name)),
                    name.pointer());
  }
  owner = agent;
}

/// @param kind "an equation" or "an update"
void check_state_names(const Node& object, const std::string& kind, const std::vector<std::string>& states) {
  for (const std::string& key : object.keys()) {
    if (std::find(states.begin(), states.end(), key) != states.end()) continue;
    throw SpecError(
        fmt::format("{} for {}, which is no state{}", kind, quote_text(key), suggestion(key, states)),
        object.pointer());
  }
}

Program read_equation(const Scope& scope, const Node& equations, const std::string& state) {
  if (!equations.has(state))
    throw SpecError("missing equation for the state " + quote_text(state), equations.pointer());
  return scope.expression(equations[state], ExpectedType::number, Dependence::everything);
}

/// The state keeps its value between the samples; the text is that of its update.
Program zero(const std::string& text) {
  Program program;
  program.text = text;
  program.nodes = {{Operator::constant}};
  program.constants = {0};
  return program;
}

/// The slot of a variable that is not a point in a cell: a state that is not discrete, or a disturbance.
bool is_box(const Scope& scope, const std::vector<StateSpec>& states, std::uint32_t slot) {
  return slot < states.size() ? !states[slot].discrete : scope.is_disturbance(slot);
}

/// The first such variable that is read outside of the conditions of `if`; nothing if there is none.
std::optional<std::size_t> box_read_as_number(const Scope& scope, const Program& program,
                                              const std::vector<StateSpec>& states) {
  std::vector<bool> needed(program.nodes.size(), false);
  needed.back() = true;
  std::optional<std::size_t> found;
  for (std::size_t i = needed.size(); i-- > 0;) {
    const Program::Node& node = program.nodes[i];
    if (!needed[i]) continue;
    if (node.op == Operator::variable && is_box(scope, states, node.a)) found = node.a;
    const std::size_t operands = operand_count(node.op);
    if (operands > 0 && node.op != Operator::if_else) needed[node.a] = true;
    if (operands > 1) needed[node.b] = true;
    if (operands > 2) needed[node.c] = true;
  }
  return found;
}

/// The equation of a discrete state in discrete time asks in conditions where continuous states are, or what
/// disturbances do.
bool is_update(const Scope& scope, const Program& equation, const std::vector<StateSpec>& states) {
  const std::vector<std::uint32_t> slots = equation.variables();
  return std::any_of(slots.begin(), slots.end(),
                     [&](std::uint32_t slot) { return is_box(scope, states, slot); }) &&
         !box_read_as_number(scope, equation, states);
}

void check_updates(const Node& updates, const Node& equations, Time time,
                   const std::vector<std::string>& states) {
  if (time == Time::discrete) {
    throw SpecError("updates are for continuous time, expected the next values in 'equations'",
                    updates.pointer());
  }
  check_state_names(updates, "an update", states);
  for (const std::string& key : updates.keys()) {
    if (!equations.has(key)) continue;
    throw SpecError(fmt::format("{} has an equation too, expected one of the two", quote_text(key)),
                    updates[key].pointer());
  }
}

UpdateSpec read_update(const Scope& scope, const Node& node, const StateSpec& state,
                       const std::vector<StateSpec>& states) {
  if (!state.discrete)
    throw SpecError(fmt::format("{} is no discrete state, expected an equation", quote_text(state.name)),
                    node.pointer());
  if (state.has(Outside::stop)) {
    throw SpecError(
        fmt::format("{} jumps at samples, expected another 'outside' than 'stop'", quote_text(state.name)),
        node.pointer());
  }
  UpdateSpec update{scope.expression(node, ExpectedType::number, Dependence::states_and_inputs)};
  if (const auto box = box_read_as_number(scope, update.value, states)) {
    throw SpecError(
        fmt::format("expected discrete states and inputs outside of the conditions of 'if', found "
                    "the state {}",
                    quote_text(states[*box].name)),
        node.pointer());
  }
  return update;
}

}  // namespace

Time read_time(const Node& root) {
  return root["dynamics"]["time"].text() == "discrete" ? Time::discrete : Time::continuous;
}

std::vector<AgentSpec> read_agents(const Scope& scope, const Node& root,
                                   const std::vector<InputSpec>& inputs) {
  const std::vector<std::string> input_names = names_of(inputs);
  std::vector<std::int32_t> owners(inputs.size(), kNobody);
  std::vector<AgentSpec> agents;
  for (const Node& object : root.elements("agents")) {
    check_new_name(object["name"], names_of(agents), "agent");
    AgentSpec agent;
    agent.name = object["name"].text();
    for (const Node& name : object.elements("inputs")) {
      agent.inputs.push_back(index_of_name(name, input_names, "an input"));
      take_input(name, agent.inputs.back(), static_cast<std::int32_t>(agents.size()), agents, owners);
    }
    std::sort(agent.inputs.begin(), agent.inputs.end());
    if (object.has("prefer")) {
      agent.prefer = scope.expression(object["prefer"], ExpectedType::number, Dependence::states_and_inputs);
    }
    if (object.has("sees")) agent.sees = read_sees(object, state_names(root));
    agents.push_back(std::move(agent));
  }
  const auto orphan = std::find(owners.begin(), owners.end(), kNobody);
  if (orphan != owners.end()) {
    const std::string& name = input_names[static_cast<std::size_t>(orphan - owners.begin())];
    throw SpecError("the input " + quote_text(name) + " belongs to no agent", root["agents"].pointer());
  }
  return agents;
}

Rational read_period(const Scope& scope, const Node& root) {
  const Node node = root["dynamics"]["period"];
  Rational period = scope.time(node);
  if (period <= 0) throw SpecError("expected a period > 0, found " + to_text(period), node.pointer());
  return period;
}

DynamicsSpec read_dynamics(const Scope& scope, const Node& root, const Rational& period,
                           const std::vector<StateSpec>& states) {
  const Node object = root["dynamics"];
  DynamicsSpec dynamics{.time = read_time(root), .period = period};
  ErrorList errors;
  errors.attempt([&] { dynamics.unit = read_unit(object); });
  const Node equations = object["equations"];
  const std::vector<std::string> names = state_names(root);
  bool are_known = errors.attempt([&] { check_state_names(equations, "an equation", names); });
  if (object.has("updates")) {
    are_known = errors.attempt([&] { check_updates(object["updates"], equations, dynamics.time, names); }) &&
                are_known;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::optional<UpdateSpec>& update = dynamics.updates.emplace_back();
    const bool jumps = object.has("updates") && object["updates"].has(names[i]);
    if (!are_known && !jumps && !equations.has(names[i])) continue;  // most likely one spelt differently
    errors.attempt([&] {
      dynamics.equations.push_back(jumps ? zero(object["updates"][names[i]].text())
                                         : read_equation(scope, equations, names[i]));
    });
    if (i >= states.size()) continue;  // there are errors
    if (jumps)
      errors.attempt([&] { update = read_update(scope, object["updates"][names[i]], states[i], states); });
    const bool is_map = dynamics.time == Time::discrete && states[i].discrete;
    if (!is_map || dynamics.equations.size() != i + 1) continue;
    if (is_update(scope, dynamics.equations[i], states)) update = UpdateSpec{dynamics.equations[i]};
  }
  errors.raise();
  return dynamics;
}

AbstractionSpec read_abstraction(const Node& root) {
  AbstractionSpec abstraction;
  if (!root.has("abstraction")) return abstraction;
  const Node object = root["abstraction"];
  if (object.text_or("cells", "closed") == "half_open") abstraction.cells = Cells::half_open;
  if (object.text_or("safe", "inner") == "center") abstraction.safe = Membership::center;
  abstraction.between_samples = object.flag("between_samples");
  if (object.has("effort")) abstraction.effort = object["effort"].integer();
  if (abstraction.between_samples && read_time(root) == Time::discrete) {
    throw SpecError("discrete time has nothing between samples, expected false, found true",
                    object["between_samples"].pointer());
  }
  return abstraction;
}

ControllerSpec read_controller(const Scope& scope, const Node& root) {
  ControllerSpec controller;
  if (!root.has("controller")) return controller;
  const Node object = root["controller"];
  if (object.text_or("synthesis", "maximal") == "given") controller.synthesis = Synthesis::given;
  if (object.has("allow")) {
    controller.allow =
        scope.expression(object["allow"], ExpectedType::condition, Dependence::states_and_inputs);
  }
  if (object.has("file")) controller.file = object["file"].text();
  return controller;
}

OutputSpec read_output(const Node& root) {
  OutputSpec output;
  if (!root.has("output")) return output;
  const Node object = root["output"];
  output.controller = object.flag("controller");
  output.actions = object.flag("actions");
  output.layers = object.flag("layers");
  output.abstraction = object.flag("abstraction");
  return output;
}

}  // namespace coordreq

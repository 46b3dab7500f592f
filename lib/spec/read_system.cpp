#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
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

constexpr std::int32_t kNobody = -1;

/// Gives an input to agent `agent`. REQUIRES: `owners` holds the agent that owns each input, or kNobody.
void take_input(const Node& name, std::int32_t input, std::int32_t agent,
                const std::vector<AgentSpec>& agents, std::vector<std::int32_t>& owners) {
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

void check_equation_names(const Node& equations, const std::vector<std::string>& states) {
  for (const std::string& key : equations.keys()) {
    if (std::find(states.begin(), states.end(), key) != states.end()) continue;
    throw SpecError(
        fmt::format("an equation for {}, which is no state{}", quote_text(key), suggestion(key, states)),
        equations.pointer());
  }
}

Program read_equation(const Scope& scope, const Node& equations, const std::string& state) {
  if (!equations.has(state))
    throw SpecError("missing equation for the state " + quote_text(state), equations.pointer());
  return scope.expression(equations[state], ExpectedType::number, Over::everything);
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
      agent.prefer = scope.expression(object["prefer"], ExpectedType::number, Over::states_and_inputs);
    }
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
  Rational period = scope.number(node);
  if (period <= 0) throw SpecError("expected a period > 0, found " + to_text(period), node.pointer());
  return period;
}

DynamicsSpec read_dynamics(const Scope& scope, const Node& root, const Rational& period) {
  const Node object = root["dynamics"];
  DynamicsSpec dynamics{.time = read_time(root), .period = period};
  ErrorList errors;
  errors.attempt([&] { dynamics.unit = read_unit(object); });
  const Node equations = object["equations"];
  std::vector<std::string> states;
  for (const Node& state : root.elements("states")) states.push_back(state["name"].text());
  const bool are_known = errors.attempt([&] { check_equation_names(equations, states); });
  for (const std::string& state : states) {
    if (!are_known && !equations.has(state)) continue;  // most likely the one that is spelt differently
    errors.attempt([&] { dynamics.equations.push_back(read_equation(scope, equations, state)); });
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
    controller.allow = scope.expression(object["allow"], ExpectedType::condition, Over::states_and_inputs);
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

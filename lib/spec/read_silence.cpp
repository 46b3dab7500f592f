#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "spec/problem_spec.hpp"
#include "spec/spec_parts.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// [agent] the conditions of an object by names of agents.
std::vector<std::optional<Program>> read_rules(const Scope& scope, const Node& object,
                                               const std::vector<AgentSpec>& agents) {
  std::vector<std::string> names;
  for (const AgentSpec& agent : agents) names.push_back(agent.name);
  std::vector<std::optional<Program>> rules(agents.size());
  for (const std::string& key : object.keys()) {
    const auto found = std::ranges::find(names, key);
    if (found == names.end()) {
      throw SpecError(fmt::format("{} is not an agent{}", quote_text(key), suggestion(key, names)),
                      object.pointer());
    }
    rules[static_cast<std::size_t>(found - names.begin())] =
        scope.expression(object[key], ExpectedType::condition, Dependence::states_and_inputs);
  }
  return rules;
}

}  // namespace

SilenceSpec read_silence(const Scope& scope, const Node& root, const std::vector<AgentSpec>& agents) {
  const Node object = root["silence"];
  SilenceSpec silence{.actions = std::vector<std::optional<Program>>(agents.size()), .then = {}};
  if (!object.has("actions") && !object.has("then"))
    throw SpecError("missing key: one of 'actions', 'then' or 'hold'", object.pointer());
  if (object.has("actions")) silence.actions = read_rules(scope, object["actions"], agents);
  if (!object.has("then")) return silence;
  silence.then = read_rules(scope, object["then"], agents);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (silence.then[i]) continue;
    throw SpecError(
        fmt::format("expected a condition for each agent, found none for {}", quote_text(agents[i].name)),
        object["then"].pointer());
  }
  return silence;
}

}  // namespace coordreq

#include "base/error.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/spec_parts.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

bool has_numbers(const Node& network) {
  return network.has("loss") || (network.has("transitions") && network["transitions"][0].size() == 3);
}

bool is_given(const Node& root) {
  return root.has("controller") && root["controller"].text_or("synthesis", "") == "given";
}

}  // namespace

RiskSpec read_risk(const Scope& scope, const Node& root, const Rational& period) {
  const Node object = root["risk"];
  if (!root.has("network") || !has_numbers(root["network"])) {
    throw SpecError("'risk' is for a network with probabilities, expected 'loss' or transitions with numbers",
                    object.pointer());
  }
  RiskSpec risk;
  risk.is_safest = object.text_or("coordinated", "any") == "safest";
  if (risk.is_safest && is_given(root)) {
    throw SpecError("'safest' is for agents who choose, expected 'any' with the controller as it is 'given'",
                    object["coordinated"].pointer());
  }
  if (object.has("horizon")) {
    risk.horizon = read_integer(object["horizon"]);
    return risk;
  }
  const Node time = object["horizon_time"];
  risk.horizon_time = scope.time(time);
  risk.horizon = read_steps_of_time(scope, time, period);
  if (risk.horizon == 0) throw SpecError("expected a time > 0, found 0", time.pointer());
  return risk;
}

}  // namespace coordreq

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "base/error.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/spec_parts.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

constexpr std::size_t kMostNamed = 8;

bool has_numbers(const Node& network) {
  return network.has("loss") || (network.has("transitions") && network["transitions"][0].size() == 3);
}

bool is_given(const Node& root) {
  return root.has("controller") && root["controller"].text_or("synthesis", "") == "given";
}

/// Where the network is at the first step.
void read_start(const Node& object, const NetworkSpec& network, RiskSpec& risk) {
  const std::string start = object.text_or("start", "connected");
  if (start == "connected") return;
  risk.is_drawn = start == "drawn";
  if (risk.is_drawn) return;
  const auto mode = std::ranges::find(network.modes, start, &NetworkModeSpec::name);
  if (mode == network.modes.end()) {
    std::string names;
    for (std::size_t m = 0; m < std::min(kMostNamed, network.modes.size()); ++m)
      names += (m == 0 ? "" : ", ") + quote_text(network.modes[m].name);
    if (network.modes.size() > kMostNamed) names += ", ...";
    throw SpecError(fmt::format("expected 'connected', 'drawn' or a mode of the network ({}), found {}",
                                names, quote_text(start)),
                    object["start"].pointer());
  }
  risk.start = static_cast<std::size_t>(mode - network.modes.begin());
}

}  // namespace

RiskSpec read_risk(const Scope& scope, const Node& root, const Rational& period,
                   const std::optional<NetworkSpec>& network) {
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
  if (network) read_start(object, *network, risk);
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

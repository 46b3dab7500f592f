#include <fmt/format.h>

#include <set>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "spec/check_limits.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/loss_automaton.hpp"
#include "spec/partition_names.hpp"
#include "spec/spec_parts.hpp"
#include "spec/system_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

constexpr std::size_t kMostModes = 4096;

/// With its given name, if it has one.
PartitionSpec as_listed(PartitionSpec partition, const CoordinationSpec& coordination) {
  for (const PartitionSpec& listed : coordination.partitions) {
    if (listed.canonical == partition.canonical) return listed;
  }
  return partition;
}

/// A partition by its given name or by any canonical one, listed in the spec or not.
PartitionSpec read_partition_name(const Node& node, const std::vector<AgentSpec>& agents,
                                  const CoordinationSpec& coordination) {
  for (const PartitionSpec& partition : coordination.partitions) {
    if (partition.name == node.text()) return partition;
  }
  std::optional<PartitionSpec> partition = parse_partition_name(agents, node.text());
  if (!partition) {
    throw SpecError(
        fmt::format("expected the name of a partition, such as {}, found {}",
                    quote_text(make_partition(agents, {}, "").canonical), quote_text(node.text())),
        node.pointer());
  }
  return as_listed(*std::move(partition), coordination);
}

/// Reads the probabilities of all transitions; there may be none.
void read_probabilities(const Scope& scope, const Node& object, NetworkSpec& network) {
  for (const Node& transition : object.elements("transitions")) {
    if (transition.size() == 3) network.probabilities.push_back(read_probability(scope, transition[2]));
  }
  const std::size_t with = network.probabilities.size(), all = object["transitions"].size();
  if (with == 0 || with == all) return;
  throw SpecError(
      fmt::format("expected a probability in all transitions or in none, found {} of {} with one", with, all),
      object["transitions"].pointer());
}

void read_automaton(const Scope& scope, const Node& object, const std::vector<AgentSpec>& agents,
                    const CoordinationSpec& coordination, NetworkSpec& network) {
  check_mode_count(object["modes"].size(), kMostModes, object["modes"].pointer());
  std::vector<std::string> names;
  for (const Node& mode : object.elements("modes")) {
    check_new_name(mode["name"], names, "mode");
    names.push_back(mode["name"].text());
    network.modes.push_back({names.back(), read_partition_name(mode["partition"], agents, coordination)});
  }
  std::set<std::pair<std::int32_t, std::int32_t>> known;
  std::vector<bool> is_left(names.size(), false);
  for (const Node& pair : object.elements("transitions")) {
    const std::pair transition{index_of_name(pair[0], names, "a mode"),
                               index_of_name(pair[1], names, "a mode")};
    if (!known.insert(transition).second) {
      throw SpecError(fmt::format("the transition from {} to {} is listed twice", quote_text(pair[0].text()),
                                  quote_text(pair[1].text())),
                      pair.pointer());
    }
    network.transitions.push_back(transition);
    is_left[static_cast<std::size_t>(transition.first)] = true;
  }
  for (std::size_t mode = 0; mode < names.size(); ++mode) {
    if (!is_left[mode]) {
      throw SpecError(fmt::format("the mode {} has no successor", quote_text(names[mode])),
                      object["modes"][mode].pointer());
    }
  }
  read_probabilities(scope, object, network);
  settle_probabilities(network, object["transitions"].pointer());
}

void read_weakly_hard(const Node& object, NetworkSpec& network) {
  network.misses = read_integer(object["misses"]);
  network.window = read_integer(object["window"]);
  if (network.misses > network.window) {
    throw SpecError(
        fmt::format("expected at most window = {} misses, found {}", network.window, network.misses),
        object["misses"].pointer());
  }
}

/// The partition under "up" or "down", or the usual one.
PartitionSpec read_side(const Node& object, const std::string& key, const AgentClasses& usual,
                        const std::vector<AgentSpec>& agents, const CoordinationSpec& coordination) {
  if (object.has(key)) return read_partition_name(object[key], agents, coordination);
  return as_listed(make_partition(agents, usual, ""), coordination);
}

/// Connected steps, in the first mode, and lost ones.
LossAutomaton read_loss(const Scope& scope, const Node& object, NetworkSpec& network) {
  network.kind = NetworkKind::loss;
  network.loss = read_probability(scope, object["loss"]);
  network.after_loss =
      object.has("after_loss") ? read_probability(scope, object["after_loss"]) : network.loss;
  for (const ProbabilityRange& lost : {network.loss, network.after_loss}) {
    network.probabilities.push_back({1 - lost.high, 1 - lost.low});
    network.probabilities.push_back(lost);
  }
  return {.names = {"1", "0"}, .transitions = {{0, 0}, {0, 1}, {1, 0}, {1, 1}}};
}

std::optional<LossAutomaton> read_losses(const Node& object, NetworkSpec& network) {
  if (object.has("delay")) {
    network.kind = NetworkKind::delay;
    network.delay = read_integer(object["delay"]);
    return delay_automaton(network.delay, kMostModes);
  }
  if (object.has("burst")) {
    network.kind = NetworkKind::burst;
    network.burst_length = read_integer(object["burst"]["length"]);
    network.burst_gap = read_integer(object["burst"]["gap"]);
    return burst_automaton(network.burst_length, network.burst_gap, kMostModes);
  }
  network.kind = NetworkKind::weakly_hard;
  read_weakly_hard(object["weakly_hard"], network);
  return weakly_hard_automaton(network.misses, network.window, kMostModes);
}

/// The name of a mode; a word for networks that know no more than the present step.
std::string mode_name(const LossAutomaton& losses, std::size_t mode, NetworkKind kind) {
  if (kind != NetworkKind::loss) return losses.names[mode];
  return losses.is_up(mode) ? "up" : "down";
}

/// All agents are connected or none is, in turns that the network's kind allows.
void unfold_losses(const Scope& scope, const Node& object, const std::vector<AgentSpec>& agents,
                   const CoordinationSpec& coordination, NetworkSpec& network) {
  std::optional<LossAutomaton> losses =
      object.has("loss") ? read_loss(scope, object, network) : read_losses(object, network);
  const std::string kind = network_kind_name(network.kind);
  if (!losses) {
    throw LimitError(fmt::format("more than {} modes, the most that are possible", kMostModes),
                     object[kind].pointer());
  }
  AgentClasses everyone(1);
  for (std::size_t a = 0; a < agents.size(); ++a) everyone[0].push_back(static_cast<std::int32_t>(a));
  const PartitionSpec up = read_side(object, "up", everyone, agents, coordination);
  const PartitionSpec down = read_side(object, "down", {}, agents, coordination);
  for (std::size_t mode = 0; mode < losses->names.size(); ++mode)
    network.modes.push_back({mode_name(*losses, mode, network.kind), losses->is_up(mode) ? up : down});
  network.transitions = std::move(losses->transitions);
  settle_probabilities(network, object.pointer());
}

/// What agents do in modes of more than one class.
void read_actions(const Node& root, NetworkSpec& network) {
  const Node object = root["network"];
  network.has_actions = object.has("actions");
  network.acts_by_rule = network.has_actions && object["actions"].text() == "silence";
  if (!network.acts_by_rule) return;
  if (!root.has("silence")) {
    throw SpecError("the spec has no communication-loss rule, expected the key 'silence' or \"independent\"",
                    object["actions"].pointer());
  }
  if (network.resynthesise) {
    throw SpecError("agents with robust re-synthesis follow no rule, expected \"independent\"",
                    object["actions"].pointer());
  }
}

}  // namespace

std::string network_kind_name(NetworkKind kind) {
  switch (kind) {
    case NetworkKind::automaton:
      return "automaton";
    case NetworkKind::delay:
      return "delay";
    case NetworkKind::burst:
      return "burst";
    case NetworkKind::weakly_hard:
      return "weakly_hard";
    case NetworkKind::loss:
      return "loss";
  }
  return {};
}

NetworkSpec read_network(const Scope& scope, const Node& root, const std::vector<AgentSpec>& agents,
                         const CoordinationSpec& coordination) {
  const Node object = root["network"];
  NetworkSpec network;
  network.resynthesise = object.flag("resynthesise");
  read_actions(root, network);
  if (object.has("modes")) {
    read_automaton(scope, object, agents, coordination, network);
  } else {
    unfold_losses(scope, object, agents, coordination, network);
  }
  return network;
}

}  // namespace coordreq

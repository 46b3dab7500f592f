#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "spec/partition_names.hpp"
#include "spec/spec_parts.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

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
  for (const PartitionSpec& listed : coordination.partitions) {
    if (listed.canonical == partition->canonical) return listed;
  }
  return *std::move(partition);
}

void read_automaton(const Node& object, const std::vector<AgentSpec>& agents,
                    const CoordinationSpec& coordination, NetworkSpec& network) {
  std::vector<std::string> names;
  for (const Node& mode : object.elements("modes")) {
    check_new_name(mode["name"], names, "mode");
    names.push_back(mode["name"].text());
    network.modes.push_back({names.back(), read_partition_name(mode["partition"], agents, coordination)});
  }
  for (const Node& pair : object.elements("transitions")) {
    const std::pair transition{index_of_name(pair[0], names, "a mode"),
                               index_of_name(pair[1], names, "a mode")};
    auto& known = network.transitions;
    if (std::find(known.begin(), known.end(), transition) != known.end()) {
      throw SpecError(fmt::format("the transition from {} to {} is listed twice", quote_text(pair[0].text()),
                                  quote_text(pair[1].text())),
                      pair.pointer());
    }
    known.push_back(transition);
  }
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

}  // namespace

NetworkSpec read_network(const Node& root, const std::vector<AgentSpec>& agents,
                         const CoordinationSpec& coordination) {
  const Node object = root["network"];
  NetworkSpec network;
  network.resynthesise = object.flag("resynthesise");
  if (object.has("modes")) {
    network.kind = NetworkKind::automaton;
    read_automaton(object, agents, coordination, network);
  } else if (object.has("delay")) {
    network.kind = NetworkKind::delay;
    network.delay = read_integer(object["delay"]);
  } else if (object.has("burst")) {
    network.kind = NetworkKind::burst;
    network.burst_length = read_integer(object["burst"]["length"]);
    network.burst_gap = read_integer(object["burst"]["gap"]);
  } else {
    network.kind = NetworkKind::weakly_hard;
    read_weakly_hard(object["weakly_hard"], network);
  }
  return network;
}

}  // namespace coordreq

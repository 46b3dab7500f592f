#include "answers/coalition/coalition_cost.hpp"

#include <algorithm>

#include "spec/coordination_spec.hpp"

namespace coordreq {
namespace {

Rational link_cost(std::int32_t a, std::int32_t b, const std::vector<LinkCostSpec>& links) {
  const auto [first, second] = std::minmax(a, b);
  for (const LinkCostSpec& link : links) {
    if (link.first == first && link.second == second) return link.cost;
  }
  return 1;
}

/// Grows the tree from the first agent, each time by the agent outside that is cheapest to reach.
Rational tree_cost(const std::vector<std::int32_t>& agents, const std::vector<LinkCostSpec>& links) {
  std::vector<std::pair<Rational, std::int32_t>> outside;
  for (std::size_t i = 1; i < agents.size(); ++i)
    outside.emplace_back(link_cost(agents[0], agents[i], links), agents[i]);
  Rational total = 0;
  while (!outside.empty()) {
    const auto nearest = std::min_element(outside.begin(), outside.end());
    const auto [cost, agent] = *nearest;
    outside.erase(nearest);
    total += cost;
    for (auto& [reach, other] : outside) reach = std::min(reach, link_cost(agent, other, links));
  }
  return total;
}

std::size_t largest_class(const PartitionSpec& partition) {
  std::size_t largest = 0;
  for (const auto& agents : partition.classes) largest = std::max(largest, agents.size());
  return largest;
}

}  // namespace

std::vector<AgentPair> agent_pairs(std::size_t agents) {
  std::vector<AgentPair> pairs;
  for (std::size_t a = 0; a < agents; ++a) {
    for (std::size_t b = a + 1; b < agents; ++b)
      pairs.emplace_back(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  }
  return pairs;
}

bool are_together(const PartitionSpec& partition, const AgentPair& pair) {
  return std::any_of(partition.classes.begin(), partition.classes.end(), [&](const auto& agents) {
    return std::find(agents.begin(), agents.end(), pair.first) != agents.end() &&
           std::find(agents.begin(), agents.end(), pair.second) != agents.end();
  });
}

Rational network_cost(const PartitionSpec& partition, const std::vector<LinkCostSpec>& links) {
  Rational total = 0;
  for (const auto& agents : partition.classes) total += tree_cost(agents, links);
  return total;
}

std::vector<CoalitionChoice> order_of_preference(const CoordinationSpec& coordination) {
  std::vector<CoalitionChoice> choices;
  for (std::size_t p = 0; p < coordination.partitions.size(); ++p)
    choices.push_back({p, network_cost(coordination.partitions[p], coordination.link_cost)});
  std::sort(choices.begin(), choices.end(), [&](const CoalitionChoice& a, const CoalitionChoice& b) {
    const PartitionSpec& one = coordination.partitions[a.partition];
    const PartitionSpec& other = coordination.partitions[b.partition];
    if (a.cost != b.cost) return a.cost < b.cost;
    if (largest_class(one) != largest_class(other)) return largest_class(one) < largest_class(other);
    return one.name < other.name;
  });
  return choices;
}

}  // namespace coordreq

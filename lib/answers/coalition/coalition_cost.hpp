#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Two agents, the first of a lower number.
using AgentPair = std::pair<std::int32_t, std::int32_t>;

/// All pairs of so many agents: (0, 1), (0, 2), ..., (1, 2), ...
[[nodiscard]] std::vector<AgentPair> agent_pairs(std::size_t agents);

/// True if the two coordinate within a step.
[[nodiscard]] bool are_together(const PartitionSpec& partition, const AgentPair& pair);

/// The cost of the cheapest communication network for the partition: the least sum of link costs over the
/// graphs whose connected components are the classes, which is that of a minimum spanning tree of each class
/// (Prim's algorithm). Links not listed cost 1, so without a list the cost is agents minus classes. Exact.
[[nodiscard]] Rational network_cost(const PartitionSpec& partition, const std::vector<LinkCostSpec>& links);

/// A partition, and its cost.
struct CoalitionChoice {
  std::size_t partition = 0;  ///< index into the partitions of the spec
  Rational cost;
};

/// The partitions, the most preferred first: by cost, then by the size of the largest class, then by name
/// (byte by byte). No two rank equal, as names differ.
[[nodiscard]] std::vector<CoalitionChoice> order_of_preference(const CoordinationSpec& coordination);

}  // namespace coordreq

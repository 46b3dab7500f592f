#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spec/spec_types.hpp"

namespace coordreq {

using AgentClasses = std::vector<std::vector<std::int32_t>>;

/// "a+b": the agents of a class in spec order.
[[nodiscard]] std::string class_name(const std::vector<AgentSpec>& agents,
                                     const std::vector<std::int32_t>& members);

/// The partition with these classes and every agent not listed alone, in canonical order; `name` empty stands
/// for the canonical name. @pre no agent twice, no class empty
[[nodiscard]] PartitionSpec make_partition(const std::vector<AgentSpec>& agents, AgentClasses classes,
                                           std::string name);

/// Every partition of the agents, each under its canonical name: those with fewer classes first, so coarser
/// ones before finer ones; with as many classes, in lexicographic order of the list that has for each agent
/// the number of its class, so agents together with the first ones before. Bell(agents) of them.
/// Example: a+b+c, a+b|c, a+c|b, a|b+c, a|b|c.
[[nodiscard]] std::vector<PartitionSpec> make_all_partitions(const std::vector<AgentSpec>& agents);

/// The partition called "a+b|c", agents and classes in any order; nothing unless every agent is named exactly
/// once.
[[nodiscard]] std::optional<PartitionSpec> parse_partition_name(const std::vector<AgentSpec>& agents,
                                                                std::string_view text);

}  // namespace coordreq

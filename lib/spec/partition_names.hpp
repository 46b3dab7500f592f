#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spec/problem_spec.hpp"

namespace coordreq {

using AgentClasses = std::vector<std::vector<std::int32_t>>;

/// "a+b": the agents of a class in spec order.
[[nodiscard]] std::string class_name(const std::vector<AgentSpec>& agents,
                                     const std::vector<std::int32_t>& members);

/// The partition with these classes and every agent not listed alone, in canonical order; `name` empty stands
/// for the canonical name. REQUIRES: no agent twice, no class empty.
[[nodiscard]] PartitionSpec make_partition(const std::vector<AgentSpec>& agents, AgentClasses classes,
                                           std::string name);

/// The partition called "a+b|c", agents and classes in any order; nothing unless every agent is named exactly
/// once.
[[nodiscard]] std::optional<PartitionSpec> parse_partition_name(const std::vector<AgentSpec>& agents,
                                                                std::string_view text);

}  // namespace coordreq

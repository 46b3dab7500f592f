#pragma once

#include "answers/answers.hpp"
#include "answers/network/network_safety.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The network of a spec as input of find_network_safety(); modes that connect the same agents share a
/// partition. Without a goal that ends the task.
/// @pre the spec has a network. @pre unchecked: `controller` and `hull` outlive the result
[[nodiscard]] NetworkProblem network_problem(const ProblemSpec& spec, const Controller& controller,
                                             const RowHull& hull);
/// The network of the spec, with K. @pre the spec has a network. @pre unchecked: K is known; `answers`
/// outlive the result
[[nodiscard]] NetworkProblem network_problem(const Answers& answers);

/// The different partitions of the modes of a network, in the order of the modes.
[[nodiscard]] std::vector<const PartitionSpec*> network_partitions(const NetworkSpec& network);

}  // namespace coordreq

#pragma once

#include "answers/answers.hpp"
#include "answers/network/network_safety.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The network of a spec as the operators take it; modes that connect the same agents share a partition.
/// No goal ends the task.
/// @pre the spec has a network. @pre unchecked: `controller` and `hull` outlive the result
[[nodiscard]] NetworkProblem network_problem(const ProblemSpec& spec, const Controller& controller,
                                             const RowHull& hull);
/// That of the spec, of which K is known. @pre it has a network. @pre unchecked: `answers` outlive the result
[[nodiscard]] NetworkProblem network_problem(const Answers& answers);

/// The different partitions of the modes of a network, in the order of the modes.
[[nodiscard]] std::vector<const PartitionSpec*> network_partitions(const NetworkSpec& network);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"

namespace coordreq {

/// The part of each joint input that belongs to one agent: its joint actions, row-major over its inputs.
struct AgentActions {
  std::int64_t count = 1;
  std::vector<std::int32_t> of_input;  ///< [joint input]
};

/// @param inputs of the agent, ascending
[[nodiscard]] AgentActions agent_actions(const InputSpace& space, const std::vector<std::int32_t>& inputs);

/// A convention at one state: what each agent may do, whatever the others do of theirs.
///
/// P(x) = P_1(x) x ... x P_n(x), an inclusion-maximal product in C(x): from the lowest-numbered joint input
/// on agents, in order, add their actions, ascending, as long as the product stays in C(x). Agent i finds the
/// others' sets fixed meanwhile, so P_i(x) = {a : {a} x P_1(x) x ... x P_{i-1}(x) x {seed of i+1, ..., n} is
/// in C(x)}; as the product only grows, what has been refused once is refused for good.
/// @param admissible [joint input], C(x)
/// @returns [agent][action]; all empty if C(x) is
/// Cost: agents^2 * joint inputs.
[[nodiscard]] std::vector<std::vector<bool>> convention_at(const std::vector<bool>& admissible,
                                                           const std::vector<AgentActions>& agents);

}  // namespace coordreq

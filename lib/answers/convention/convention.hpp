#pragma once

#include <cstdint>
#include <vector>

#include "model/input_class.hpp"

namespace coordreq {

/// A convention at one state: a set of actions for each agent, such that all agents may take any of theirs
/// together.
///
/// P(x) = P_1(x) x ... x P_n(x), an inclusion-maximal product in C(x): from the lowest-numbered joint input
/// on agents, in order, add their actions, ascending, as long as the product stays in C(x). The sets of the
/// others are fixed while agent i adds its actions, so P_i(x) = {a : {a} x P_1(x) x ... x P_{i-1}(x) x {seed
/// of i+1, ..., n} is in C(x)}; as the product only grows, an action that was refused once is refused for
/// good.
/// @param admissible [joint input], C(x)
/// @param agents each by itself; tabulated, if this is called for many states
/// @returns [agent][action]; all empty if C(x) is
/// Cost: agents^2 * joint inputs.
[[nodiscard]] std::vector<std::vector<bool>> convention_at(const std::vector<bool>& admissible,
                                                           const std::vector<InputClass>& agents);

}  // namespace coordreq

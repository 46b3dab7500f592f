#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// An agent as the abstraction has it.
struct AbstractAgent {
  std::vector<std::int32_t> inputs;
  std::vector<std::size_t> dimensions;  ///< moved by these inputs alone, and not coupled to other dimensions
};

/// The number with a[k] and b[k] exchanged for all k; a number in neither list stays.
template <class Number>
[[nodiscard]] Number exchanged(const std::vector<Number>& a, const std::vector<Number>& b, Number one) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] == one) return b[k];
    if (b[k] == one) return a[k];
  }
  return one;
}

/// [agent] Its inputs and its dimensions; no dimensions if they are coupled to those of other agents.
/// @param inputs [agent]
[[nodiscard]] std::vector<AbstractAgent> abstract_agents(
    const Abstraction& abstraction, const std::vector<std::vector<std::int32_t>>& inputs);

/// The other agent with its dimensions in the order in which they match those of `one`: exchanging the two
/// maps posts (and tubes) to posts. Nothing if no order of the dimensions does so, or if the tables do not
/// show it.
///
/// Why: results that follow from posts, and from sets that the exchange keeps, are then equal in cells that
/// differ in the order of the two alone (RowSymmetry), so that only one order is computed. Three vehicles
/// take 0.63 of their time and two thirds of the memory. The switch is FastPaths::like_agents.
[[nodiscard]] std::optional<AbstractAgent> agent_like(const Abstraction& abstraction,
                                                      const AbstractAgent& one, const AbstractAgent& other);

/// The largest set of agents any two of which can be exchanged, in each of the cell sets too: two to
/// RowSymmetry::kMostAgents of them, or none. All their dimensions are across rows, and match one by one.
/// @param sets known in all rows
/// @param team may be null
[[nodiscard]] std::vector<AbstractAgent> find_like_agents(const Abstraction& abstraction,
                                                          std::span<const AbstractAgent> agents,
                                                          std::span<const CellSet* const> sets,
                                                          ThreadTeam* team = nullptr);

}  // namespace coordreq

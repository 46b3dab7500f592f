#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/cell_set.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// An agent, seen from the abstraction.
struct AbstractAgent {
  std::vector<std::int32_t> inputs;     ///< its own
  std::vector<std::size_t> dimensions;  ///< that these, and no others, move, and that move no others
};

/// What one list has k-th for what the other one has k-th; all else stays what it is.
template <class Number>
[[nodiscard]] Number exchanged(const std::vector<Number>& a, const std::vector<Number>& b, Number one) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] == one) return b[k];
    if (b[k] == one) return a[k];
  }
  return one;
}

/// [agent] its inputs and the dimensions that are its own, if there are any.
/// @param inputs [agent]
[[nodiscard]] std::vector<AbstractAgent> abstract_agents(
    const Abstraction& abstraction, const std::vector<std::vector<std::int32_t>>& inputs);

/// The part of the other agent with its dimensions in the order in which they are like those of the one:
/// posts (and tubes) after the two have changed places are then the posts before, with the two changed.
/// Nothing where that is not so, or not easily seen. What follows from posts alone, and from sets in which
/// that makes no difference, is equal, too, in cells that differ in the order of the two only (symmetry
/// reduction; Emerson and Sistla, "Symmetry and Model Checking", 1996).
[[nodiscard]] std::optional<AbstractAgent> agent_like(const Abstraction& abstraction,
                                                      const AbstractAgent& one, const AbstractAgent& other);

/// Of some agents, with dimensions across rows, the most of which any two can change places, in each of the
/// sets too; their dimensions match one by one. Two or more (RowSymmetry::kMostAgents), or none.
/// @param sets in all rows
[[nodiscard]] std::vector<AbstractAgent> find_like_agents(const Abstraction& abstraction,
                                                          std::span<const AbstractAgent> agents,
                                                          std::span<const CellSet* const> sets);

}  // namespace coordreq

#pragma once

#include <cstddef>
#include <cstdint>

#include "model/row_sample.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// True if no state depends on one from `i` on, but for itself.
/// @param tables with their `states`: TransitionTable, TableShape
template <class Tables>
[[nodiscard]] bool are_alone_from(std::size_t i, const Tables& tables) {
  for (std::size_t t = 0; t < tables.size(); ++t) {
    for (const std::int32_t state : tables[t].states) {
      if (static_cast<std::size_t>(state) >= i && static_cast<std::size_t>(state) != t) return false;
    }
  }
  return true;
}

/// The grid of an abstraction with rows along as many of the last dimensions as can be: each of them moves by
/// offsets that depend on none of them, and none of the others depends on them. So do integrators (x' = x +
/// u).
///
/// A window of offsets in each dimension is then one of lanes of the row, and what is done once a row (which
/// actions there are, which rows they lead to) is done once for a whole plane of cells: on the gridworld of
/// the paper 41 times less often. Rows stay small enough for the first-level caches, and one dimension at
/// least is left across them.
/// @param most dimensions to take together, kMostJoinedLanes apart
/// @returns the grid as it is if nothing can be joined, or if there are tubes
[[nodiscard]] UniformGrid join_rows(const Abstraction& abstraction, std::size_t most = SIZE_MAX);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <vector>

#include "engine/tube_sets.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// Posts of one cell and one joint input at a time, straight from the definitions.
struct PlainPosts {
  const Abstraction& abstraction;
  const std::vector<bool>& safe;         ///< S
  const std::vector<bool>& safe_beyond;  ///< for tubes that pass a limit where a state saturates

  /// empty != f(x, u) subset of `target`; f is empty too where the tube is not safe.
  bool stays_in(std::int64_t x, std::int64_t u, const std::vector<bool>& target) const {
    const auto post = [&](std::size_t i) { return abstraction.resolved(i, x, u); };
    return box_in(post, target) && (abstraction.tubes.empty() || has_safe_tube(x, u));
  }

  bool has_safe_tube(std::int64_t x, std::int64_t u) const {
    const auto tube = [&](std::size_t i) { return abstraction.resolved_tube(i, x, u); };
    bool beyond = false;
    for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
      beyond = beyond || passes_a_limit(abstraction.raw_tube(i, x, u), abstraction.grid[i]);
    }
    return box_in(tube, beyond ? safe_beyond : safe);
  }

  template <class Box>
  bool box_in(const Box& range_of, const std::vector<bool>& target) const {
    bool gone = false;
    std::vector<IndexRange> box;
    for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
      const ResolvedRange range = range_of(i);
      if (range.blocked) return false;
      gone = gone || range.all_left();
      box.push_back(range.inside);
    }
    return gone || all_in(box, 0, 0, target);
  }

  bool all_in(const std::vector<IndexRange>& box, std::size_t i, std::int64_t cell,
              const std::vector<bool>& target) const {
    if (i == box.size()) return target[static_cast<std::size_t>(cell)];
    for (std::int64_t k = box[i].first; k <= box[i].last; ++k) {
      if (!all_in(box, i + 1, cell + k % abstraction.grid[i].count * abstraction.grid.stride(i), target))
        return false;
    }
    return true;
  }
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "support/plain_engine.hpp"

namespace coordreq {

/// Goals (contract, sections 5 and 11) done the plain way, on the plain analysis of safety.
struct PlainGoal {
  struct Approach {
    std::vector<std::int32_t> delay;  ///< [cell] -2, -1, -4 as in the results file, INT32_MAX: unbounded
    std::vector<std::int64_t> sizes;
    std::int32_t fixed_point_index = -1;
    bool truncated = false;
  };
  std::vector<std::int32_t> arrival;  ///< [cell] -2, -1, INT32_MAX: cannot be forced
  std::vector<std::vector<bool>>
      progress;  ///< [cell][joint input] P, C in G of a goal to reach, empty outside W
  /// Of a goal to return to, if some visit can be followed by another one.
  std::optional<std::int32_t> longest_return, longest_gap;
  std::vector<Approach> partitions;
};

/// @param satisfying cells that satisfy the condition of the goal
[[nodiscard]] PlainGoal reach_goal_plainly(const ProblemSpec& spec, const Abstraction& abstraction,
                                           const std::vector<bool>& safe,
                                           const std::vector<bool>& safe_beyond, const PlainAnalysis& plain,
                                           const std::vector<bool>& satisfying);

}  // namespace coordreq

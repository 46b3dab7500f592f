#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/one_cell/policy.hpp"
#include "base/thread_team.hpp"
#include "model/uniform_grid.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Countdowns and actions of all cells of one partition, run-length coded.
struct ActionRuns {
  /// By policy, where it leaves a class nothing what the first one leaves it.
  struct Entry {
    std::vector<std::int32_t> countdowns;
    std::vector<std::vector<std::uint32_t>> sets;  ///< [policy][class]: number among ActionRuns::sets
    bool is_terminal = false;                      ///< a goal that ends the task is reached there
    [[nodiscard]] auto operator<=>(const Entry&) const = default;
  };
  std::vector<AnswerPolicy> policies;   ///< those with a trigger; the first is that of the delays
  std::vector<std::uint32_t> start;     ///< first cell of each run, ascending from 0
  std::vector<std::uint32_t> entry_of;  ///< entry of each run
  std::vector<Entry> entries;           ///< all different
  std::vector<std::vector<std::vector<bool>>> sets;  ///< [class][number]: different sets of joint actions
};

[[nodiscard]] ActionRuns find_action_runs(const ResultsReader& results, std::size_t partition,
                                          ThreadTeam& team);

/// How cells are told apart in one dimension by comparisons of doubles: cell k holds the doubles x with
/// bounds[k] <= x < bounds[k + 1], or x == bounds[k] if the dimension is discrete.
struct DimensionBounds {
  std::vector<double> bounds;
  bool discrete = false;
  bool wraps = false;  ///< the piece after the last cell belongs to cell 0
};
/// Exact: each bound is the least double that is not below the face. A discrete value, and `lower` of a
/// periodic dimension, is its nearest double.
[[nodiscard]] DimensionBounds dimension_bounds(const GridDimension& dimension);

}  // namespace coordreq

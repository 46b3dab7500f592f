#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "model/uniform_grid.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Countdowns and actions of all cells of one partition, run-length coded.
struct ActionRuns {
  struct Entry {
    std::int32_t countdown = 0;
    std::vector<std::uint32_t> sets;  ///< by class: number among `sets`
    /// The same on the way to a goal, where there is one; without a way as above, and without a goal nothing.
    std::int32_t approach_countdown = 0;
    std::vector<std::uint32_t> approach_sets;
    [[nodiscard]] auto operator<=>(const Entry&) const = default;
  };
  std::vector<std::uint32_t> start;                  ///< first cell of each run, ascending from 0
  std::vector<std::uint32_t> entry_of;               ///< entry of each run
  std::vector<Entry> entries;                        ///< all different
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

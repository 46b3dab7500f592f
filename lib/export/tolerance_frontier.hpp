#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "export/cell_table.hpp"
#include "results/results_reader.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {

/// The question for which values of one or two states so much silence is tolerated, or another limit kept.
struct ToleranceQuestion {
  std::size_t partition = 0;
  /// What has to keep the limit: `steps` at least, or at most if it is an upper limit; a probability `risk`
  /// at most. Cells outside of K, or without a number of steps, keep none.
  RequirementKind kind = RequirementKind::min_delay;
  std::int64_t steps = 1;
  double risk = 0;
  /// A state whose values are sought, and whether larger ones are better.
  struct Axis {
    std::size_t state = 0;
    bool is_large_best = true;
  };
  std::vector<Axis> axes;                    ///< one or two
  std::vector<TableSelection::Slice> given;  ///< cells of other states; of those not named every value counts
};

/// Indices of the states in question: in the cell of these and in all that are better in each state, the
/// delay is as large as required, whatever the states are that were not given.
using FrontierCorner = std::vector<std::int64_t>;

/// The least such region: its corners, none of which lies in the region of another, by the first state, the
/// worst value first. Of one state at most one; none: not even in the best cell. Cells outside of K tolerate
/// nothing. Memory: a bit for each pair of values, and what CellTable takes.
struct Tolerance {
  std::vector<FrontierCorner> corners;
  /// Of one state: all values that are tolerated, as runs of indices first, ..., last, ascending.
  std::vector<std::pair<std::int64_t, std::int64_t>> intervals;
};

/// @pre the states of a question are all different; the results have the dataset of the kind
[[nodiscard]] Tolerance find_tolerance(const ResultsReader& results, const ToleranceQuestion& question);
/// The corners alone.
[[nodiscard]] std::vector<FrontierCorner> tolerance_frontier(const ResultsReader& results,
                                                             const ToleranceQuestion& question);

}  // namespace coordreq

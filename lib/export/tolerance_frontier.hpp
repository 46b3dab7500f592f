#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/cell_table.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The question from which values of one or two states on so much silence is tolerated.
struct ToleranceQuestion {
  std::size_t partition = 0;
  std::int64_t steps = 1;  ///< that the delay has to be at least
  /// A state whose values are sought, and whether larger ones are better.
  struct Over {
    std::size_t state = 0;
    bool is_large_best = true;
  };
  std::vector<Over> over;                    ///< one or two
  std::vector<TableSelection::Slice> given;  ///< cells of other states; of those not named every value counts
};

/// Indices of the states asked about: in the cell of these and in all that are better in each state, the
/// delay is as large as asked for, whatever the states are that were not given.
using FrontierCorner = std::vector<std::int64_t>;

/// The least such region: its corners, none of which lies in the region of another, by the first state, the
/// worst value first. Of one state at most one; none: not even in the best cell. Cells outside of K tolerate
/// nothing. Memory: a bit for each pair of values, and what CellTable takes.
/// @pre the states of a question are all different
[[nodiscard]] std::vector<FrontierCorner> tolerance_frontier(const ResultsReader& results,
                                                             const ToleranceQuestion& question);

}  // namespace coordreq

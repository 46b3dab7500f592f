#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/counterexample/result_path.hpp"
#include "answers/one_cell/explain_context.hpp"
#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Why a cell tolerates so much silence in a partition, and no more.
///
/// Delays are those of `/delay`: steps, kUnbounded where silence may last indefinitely, -1 and -2 outside K
/// and S.
struct DelayExplanation {
  std::int32_t delay = 0;
  bool is_lower_bound = false;  ///< `max_delay` ended the iteration before
  bool is_terminal = false;     ///< a goal that ends the task is reached there
  /// A shortest path out of S on which each class picks from its projection of C(x) as long as that is in K
  /// (find_counterexample()); none where the delay has no known end.
  std::optional<ResultPath> path;
  // The members below are set only in K.
  std::int64_t together = 0;               ///< |C(x)|
  std::int64_t alone = 0;                  ///< |IND_C(x)|, the product of the projections
  std::vector<std::vector<bool>> actions;  ///< the projections, [class][action]

  /// A class that keeps to one of its actions at this cell, whatever the others do of theirs; as an `allow`
  /// would have it. K stays, IND_C(x) shrinks, so that no delay anywhere gets shorter.
  struct Remedy {
    std::size_t class_number = 0;
    std::int64_t action = 0;
    std::int32_t delay = 0;  ///< at least; the greatest that one of its actions gives, the lowest-numbered
  };
  std::vector<Remedy> remedies;  ///< those that give more than `delay`

  /// A cell along one dimension with a longer delay although less is left to the classes.
  struct Neighbour {
    std::int64_t cell = 0;
    std::int32_t delay = 0;
    std::int64_t alone = 0;
  };
  /// The explanation for agents who follow the rules of `silence`, if the spec has any.
  struct Silence {
    std::int32_t steps = 0;       ///< as `/silence`
    bool is_lower_bound = false;  ///< likewise
    /// A shortest path out of K', or of S without a rule for the time after silence; none where it has no
    /// known end.
    std::optional<ResultPath> path;
    std::vector<std::vector<bool>> actions;  ///< [class][action] what they may do here
  };
  std::optional<Silence> silence;  ///< not in terminal cells

  std::vector<Explained> others;  ///< what answers add, in their order

  std::optional<Neighbour> freer_is_shorter;  ///< the nearest, of equals in the first dimension, below first
};

/// Memory of explaining the delay of a cell, and of its text.
[[nodiscard]] MemoryDemand explain_demand(const ResultsReader& results, std::size_t partition,
                                          std::int64_t cell);
/// @param cell its number in the spec's grid @param state in it
/// @throws as FileSets and CellController
/// Cost: that of the counterexample, of the abstraction, and of reading cells near the path and along the
/// axes.
[[nodiscard]] DelayExplanation explain_delay(const ResultsReader& results, std::size_t partition,
                                             std::int64_t cell, const std::vector<Rational>& state,
                                             ThreadTeam& team);

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "cell/cell_posts.hpp"
#include "cell/set_window.hpp"
#include "cell/tube_safety.hpp"
#include "expression/condition.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The controller C(x) of a results file and its projections, one cell at a time (contract, "Controller",
/// "Partition"): from the file where they are stored, else from the definition, with K from the file and
/// posts and tubes from the embedded spec.
///
/// Not thread-safe.
class CellController {
 public:
  /// REQUIRES: `results` and `team` outlive this object.
  CellController(const ResultsReader& results, ThreadTeam& team);

  /// Makes ready for all cells, not just a few: reads K and computes the abstraction, if they will be needed.
  void prepare_all();

  /// Whether each joint input is in C(x); none is outside K. @throws ResultsError if it cannot be computed
  [[nodiscard]] const std::vector<bool>& joint_inputs(std::int64_t cell);
  /// Whether each joint action of each class is admissible: [class][action].
  [[nodiscard]] std::vector<std::vector<bool>> actions(std::size_t partition, std::int64_t cell);
  /// Whether the convention leaves each agent each of its actions: [agent][action]; none outside K.
  [[nodiscard]] std::vector<std::vector<bool>> convention(std::int64_t cell);

 private:
  [[nodiscard]] std::vector<bool> compute(std::int64_t cell);
  [[nodiscard]] std::vector<bool> allowed(std::int64_t cell);
  [[nodiscard]] bool is_allowed(std::vector<Interval>& box, std::vector<RationalInterval>& exact_box);

  const ResultsReader& results_;
  CellPosts posts_;
  SetWindow invariant_;
  std::optional<TubeSafety> tubes_;        ///< none unless safety is asked for between the samples
  std::optional<ConditionDecider> allow_;  ///< none if everything is allowed
  std::int64_t cell_ = -1;                 ///< the one that `joint_inputs_` is of
  std::vector<bool> joint_inputs_;
};

/// The inputs of a class of agents, ascending.
[[nodiscard]] std::vector<std::int32_t> inputs_of_class(const ProblemSpec& spec,
                                                        const std::vector<std::int32_t>& agents);

}  // namespace coordreq

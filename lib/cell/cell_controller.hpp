#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "base/thread_team.hpp"
#include "cell/safe_beyond_file.hpp"
#include "cell/set_window.hpp"
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
  CellController(const CellController&) = delete;
  CellController& operator=(const CellController&) = delete;
  ~CellController() = default;

  /// Makes ready for all cells, not just a few: reads K and computes the abstraction, if they will be needed.
  void prepare_all();

  /// Whether each joint input is in C(x); none is outside K. @throws ResultsError if it cannot be computed
  [[nodiscard]] const std::vector<bool>& joint_inputs(std::int64_t cell);
  /// Whether `allow` forbids a joint input at a cell.
  [[nodiscard]] bool forbids(std::int64_t cell, std::int64_t u) { return admissible_.forbids(cell, u); }
  /// Whether each joint action of each class is admissible: [class][action].
  [[nodiscard]] std::vector<std::vector<bool>> actions(std::size_t partition, std::int64_t cell);
  /// The same on the way to the goal, of the progress controller; none outside W \ G. REQUIRES: there is a
  /// goal.
  [[nodiscard]] std::vector<std::vector<bool>> approach_actions(std::size_t partition, std::int64_t cell);
  /// Whether the convention leaves each agent each of its actions: [agent][action]; none outside K.
  [[nodiscard]] std::vector<std::vector<bool>> convention(std::int64_t cell);

 private:
  [[nodiscard]] AdmissibleInputs::Sets sets(ThreadTeam& team);
  /// C(x), or P(x) on the way to a goal.
  [[nodiscard]] std::vector<bool> inputs_of_run(std::int64_t cell);
  [[nodiscard]] std::int32_t arrival(std::int64_t cell);
  [[nodiscard]] bool is_listed(std::int64_t cell, std::int64_t u);

  const ResultsReader& results_;
  CellPosts posts_;
  SetWindow invariant_;
  SetWindow safe_;
  std::optional<SafeBeyondFile> safe_beyond_;
  AdmissibleInputs admissible_;
  ProgressInputs progress_;
  std::map<std::int64_t, std::int32_t> arrivals_;  ///< those asked for
  std::int64_t cell_ = -1;                         ///< the one that `joint_inputs_` is of
  std::vector<bool> joint_inputs_;
  std::int64_t listed_cell_ = -1;
  std::vector<bool> listed_;  ///< what `controller.file` lists there
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "answers/one_cell/policy.hpp"
#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "cell/safe_beyond_file.hpp"
#include "cell/set_window.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Whether each class may take each of its actions: [class][action].
using ActionSets = std::vector<std::vector<bool>>;

/// Bits of a file, the lowest of a byte first, as so many truth values.
[[nodiscard]] std::vector<bool> unpacked(const std::vector<std::uint8_t>& bytes, std::int64_t count);

/// Bytes of the finite abstraction of a file, as it is read or computed whole.
[[nodiscard]] double abstraction_bytes(const ResultsReader& results);
/// Memory of a CellController, in bytes: of all cells, or of one cell with those that its posts reach.
[[nodiscard]] double controller_bytes(const ResultsReader& results, bool for_all_cells);
/// controller_bytes(), with the memory of reading and of threads that compute posts.
[[nodiscard]] MemoryDemand controller_demand(const ResultsReader& results, bool for_all_cells);

/// The controller C(x) of a results file, and what policies leave of it to classes, one cell at a time
/// (contract, "Controller", "Partition"): from the file where they are stored, else from the definition, with
/// K from the file and posts and tubes from the embedded spec.
///
/// Not thread-safe.
class CellController : private ByteTables {
 public:
  /// @pre unchecked: `results` and `team` outlive this object.
  CellController(const ResultsReader& results, ThreadTeam& team);
  CellController(const CellController&) = delete;
  CellController& operator=(const CellController&) = delete;
  ~CellController() override = default;

  /// Makes ready for all cells, not just a few: reads K and computes the abstraction, if they will be needed.
  void prepare_all();

  /// The policies that the answers of the file declare, see answer_policies().
  [[nodiscard]] const std::vector<AnswerPolicy>& policies() const { return policies_; }
  /// Whether each joint input is in C(x); none is outside K. @throws ResultsError if it cannot be computed
  [[nodiscard]] const std::vector<bool>& joint_inputs(std::int64_t cell);
  /// The joint inputs that agents who coordinate choose from by a policy: those of C(x) where it does not
  /// hold.
  [[nodiscard]] std::vector<bool> joint_inputs(const AnswerPolicy& policy, std::int64_t cell);
  /// Whether `allow` forbids a joint input at a cell.
  [[nodiscard]] bool forbids(std::int64_t cell, std::int64_t u) { return admissible_.forbids(cell, u); }
  /// The actions that the policy leaves each class of a partition, or each agent if the policy is one of
  /// agents, with `countdown` steps of silence left: none outside K, and where the policy does not hold.
  [[nodiscard]] ActionSets actions(const AnswerPolicy& policy, std::size_t partition, std::int64_t cell,
                                   std::int32_t countdown);
  /// The values of a field of integers, of a partition where it is by these.
  [[nodiscard]] CellValue values(const std::string& path, std::size_t partition);
  /// Where it looks up posts; a caller moves to a cell first.
  [[nodiscard]] CellPosts& posts() { return posts_; }
  /// The projections of C(x) on the classes.
  [[nodiscard]] ActionSets actions(std::size_t partition, std::int64_t cell) {
    return actions(policies_.front(), partition, cell, 0);
  }

 private:
  /// A policy of one partition.
  struct PartitionPolicy {
    std::vector<InputClass> classes;
    std::unique_ptr<CellPolicy> policy;
  };

  [[nodiscard]] std::int64_t length(const std::string& scale) const override;
  [[nodiscard]] std::vector<std::uint8_t> bytes(const std::string& path,
                                                const std::vector<std::int64_t>& indices) const override;
  [[nodiscard]] AdmissibleInputs::Sets sets(ThreadTeam& team);
  [[nodiscard]] PartitionPolicy& policy_of(const AnswerPolicy& policy, std::size_t partition);
  [[nodiscard]] bool is_listed(std::int64_t cell, std::int64_t u);

  const ResultsReader& results_;
  std::vector<AnswerPolicy> policies_;
  CellPosts posts_;
  SetWindow invariant_;
  SetWindow safe_;
  std::optional<SafeBeyondFile> safe_beyond_;
  AdmissibleInputs admissible_;
  std::map<std::pair<std::string, std::size_t>, PartitionPolicy> policies_of_;  ///< by name and partition
  std::map<std::pair<std::string, std::size_t>, std::map<std::int64_t, std::int32_t>>
      values_;              ///< by cell, those requested
  std::int64_t cell_ = -1;  ///< the one that `joint_inputs_` is of
  std::vector<bool> joint_inputs_;
  std::int64_t listed_cell_ = -1;
  std::vector<bool> listed_;  ///< what `controller.file` lists there
};

}  // namespace coordreq

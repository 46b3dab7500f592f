#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/checked_cell.hpp"
#include "answers/checking/claimed_progress.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/checking/class_choices.hpp"
#include "answers/checking/tally.hpp"
#include "answers/invariance/check_safe.hpp"
#include "answers/requirements/result_requirement.hpp"

namespace coordreq {

/// Follows a counterexample step by step: each joint input is in IND_C of its cell (outside K: is allowed,
/// and the collision time falls by one), each next cell is in its post, the delay falls by one down to 0, and
/// the path ends as claimed. With the delays and collision times of the file, which other checks confirm, the
/// path is then a shortest one. On the way to the goal arrivals and approach delays take their place. Where
/// each step to a goal to stay at leads to the arrival that its cell forces, arrival(x) cells are outside the
/// goal, for only these lose one.
class PathChecker {
 public:
  PathChecker(const CheckContext& context, const RequirementSpec& requirement);

  /// @param tally of one requirement, for samples and steps
  void check(const ResultPath& path, Tally& tally);

 private:
  void check_sample(std::size_t sample);
  void check_step(std::size_t step);
  [[nodiscard]] PathPhase phase_of(std::size_t step) const;
  void check_together(std::size_t step, std::int64_t u);
  void check_approaching(std::size_t step, std::int64_t u);
  void check_independent(std::size_t step, std::int64_t u);
  void check_evasive(std::size_t step, std::int64_t u);
  void check_silent(std::size_t step, std::int64_t u);
  void check_afterwards(std::size_t step, std::int64_t u);
  [[nodiscard]] bool ends_without_rule(std::size_t cell);
  void check_next(std::size_t step, std::int64_t u);
  void check_last_step(std::int64_t u);
  void check_end();
  [[nodiscard]] bool ends_in_sight(std::size_t cell) const;
  void check_goal_end();
  void check_cycle(std::size_t begin);

  [[nodiscard]] std::optional<std::int64_t> input_of(std::size_t step) const;
  /// Whether the action of each class in u occurs in some of these joint inputs.
  [[nodiscard]] bool is_choice(std::int64_t u, const std::vector<std::uint8_t>& joint);
  /// Whether the rules of agents permit u at the present cell.
  [[nodiscard]] bool is_permitted(std::int64_t u, ClassChoices& rules) const;
  [[nodiscard]] bool is_in_post(std::int64_t u, std::int64_t next) const;
  [[nodiscard]] bool leaves_domain(std::int64_t u, const ResultSide& side) const;
  [[nodiscard]] const ResolvedRange& range(std::size_t i, std::int64_t u) const;
  [[nodiscard]] std::size_t entry(const Posts& posts, std::size_t i, std::int64_t u) const;
  [[nodiscard]] bool is_blocked(std::int64_t u) const;
  void wrong(std::size_t number, const std::string& what);
  /// Counts a difference: as wrong, or as open if posts may be others than those of the analysis.
  void differs(std::size_t number, const std::string& what);

  const CheckContext& context_;
  const RequirementSpec& requirement_;
  ClaimedValues value_of_;
  const std::vector<std::uint8_t>& invariant_;
  const std::vector<std::int32_t>& collision_time_;
  std::optional<std::size_t> partition_;     ///< nothing for `invariant` and `max_arrival`
  std::optional<ClaimedProgress> progress_;  ///< of requirements about the goal
  std::optional<SafeMemory> goal_memory_;    ///< of a lasting goal, with the next
  std::optional<SafeJudge> goal_;
  std::optional<ClassChoices> choices_;              ///< with a partition
  std::optional<ClassChoices> silent_, afterwards_;  ///< of `min_silence`; the second one with `then`
  CheckedCell cell_;                                 ///< of the sample being checked
  const ResultPath* path_ = nullptr;
  Tally* tally_ = nullptr;
};

}  // namespace coordreq

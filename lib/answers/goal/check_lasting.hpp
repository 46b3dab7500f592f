#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "answers/checking/claimed_progress.hpp"
#include "answers/checking/tally.hpp"
#include "answers/invariance/check_safe.hpp"
#include "base/thread_team.hpp"

namespace coordreq {

/// Checks what only goals to stay at and to return to have (contract, section 11).
///
/// 1. The equation of arrival at each cell is a certificate: whoever follows P keeps what arrival promises.
/// 2. That no arrival could be less does not follow from it: a cell may have a greater solution. With
/// `--full`
///    it is shown the other way round: from every cell the world can force what arrival says.
///
/// Threads: judge() and add_step() of different cells may be called at once.
class LastingCheck {
 public:
  /// @pre unchecked: the spec has a lasting goal; `context` outlives this object
  explicit LastingCheck(const CheckContext& context);

  struct Judged {
    std::int32_t expected = 0;  ///< arrival, by its equation
    bool is_unproven = false;   ///< it rests on a verdict that is open
  };
  /// Judges arrival in a cell of K, and notes whether the cell is in the goal: where that is open as the
  /// claim has it.
  /// @param best ClaimedProgress::best()
  [[nodiscard]] Judged judge(const CheckedCell& cell, std::int32_t claimed, SafeVerdict verdict,
                             std::int32_t best);
  /// Notes the arrival after a step from G in W, of a goal to return to.
  void add_step(std::int32_t best, std::int32_t worst);
  /// With `--full` the second check. When all cells have been judged.
  void check_all(ThreadTeam& team);
  [[nodiscard]] std::vector<Finding> findings() const;

 private:
  [[nodiscard]] bool is_return() const;
  [[nodiscard]] Finding figures() const;
  [[nodiscard]] std::vector<std::int64_t> not_forced(ThreadTeam& team) const;
  [[nodiscard]] std::vector<std::int64_t> not_lost(ThreadTeam& team) const;
  template <class Test>
  [[nodiscard]] std::vector<std::int64_t> those(const std::vector<std::int64_t>& cells, ThreadTeam& team,
                                                const Test& test) const;

  const CheckContext& context_;
  const std::vector<std::int32_t>& arrival_;
  std::vector<std::uint8_t> is_goal_;  ///< [cell] in the goal, or perhaps
  std::atomic<std::int64_t> cells_{0}, sure_{0}, possible_{0}, open_{0};
  std::atomic<std::int32_t> longest_return_{-1}, longest_gap_{-1};
  Tally least_;
};

}  // namespace coordreq

#pragma once

#include <cstdint>
#include <vector>

#include "answers/checking/checked_cell.hpp"
#include "answers/step_codes.hpp"

namespace coordreq {

/// The progress controller P by its definition, from the arrivals that a file claims.
class ClaimedProgress {
 public:
  /// @pre unchecked: the spec has a goal; `context` outlives this object
  explicit ClaimedProgress(const CheckContext& context);

  /// -2 outside S, -1 in S but not in K, kUnbounded where the goal cannot be forced.
  [[nodiscard]] std::int32_t arrival(std::size_t cell) const { return arrival_[cell]; }
  /// Whether P holds in the cell: the goal can be forced from it, and it is not in the goal, or the goal
  /// lasts.
  [[nodiscard]] bool is_before_goal(std::size_t cell) const {
    return arrival_[cell] >= (is_lasting_ ? 0 : 1) && arrival_[cell] != kUnbounded;
  }
  /// The greatest arrival in f(x,u); kUnbounded if a cell outside K may be in it, or T by way of a `safe`
  /// side, or if there is no post.
  [[nodiscard]] std::int32_t worst(CheckedCell& cell, std::int64_t u) const;
  /// The least arrival that agents can force with the next sample; `given`: the greatest. kUnbounded if C is
  /// empty.
  [[nodiscard]] std::int32_t best(CheckedCell& cell) const;
  /// The greatest worst() of a step of P. @pre unchecked: is_before_goal()
  [[nodiscard]] std::int32_t limit(CheckedCell& cell) const;
  /// P(x) as [joint input] 1 or 0. @pre unchecked: is_before_goal()
  [[nodiscard]] std::vector<std::uint8_t> of(CheckedCell& cell) const;

  /// Whether f(x,u) may be T by way of a `safe` side.
  [[nodiscard]] bool leaves_through_safe_side(const CheckedCell& cell, std::int64_t u) const;

 private:
  const CheckContext& context_;
  bool is_lasting_;
  const std::vector<std::int32_t>& arrival_;
  std::vector<std::int32_t> nearness_;  ///< [cell] kUnbounded less arrival; negative outside K
};

}  // namespace coordreq

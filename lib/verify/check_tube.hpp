#pragma once

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"
#include "model/input_space.hpp"
#include "verify/outward_posts.hpp"

namespace coordreq {

/// Raw indices of the cells, each closed and widened by the measurement error, that cover [lower, upper]
/// together: they begin at the first of these or before it and end at the last or behind it. Wide cells
/// overlap; where one of them covers all, first > last. @pre lower <= upper
[[nodiscard]] IndexRange cells_needed(const GridDimension& dimension, const Rational& lower,
                                      const Rational& upper);

/// The verifier's bounds of the cells that cover all states between the samples, from one piece of a cell.
struct TubeBounds {
  IndexRange outer;  ///< these are enough
  IndexRange inner;  ///< these are needed, as cells_needed() says

  /// From bounds as of cells_needed(): of wide cells each of which covers all, the one of the greatest index
  /// is enough.
  [[nodiscard]] static TubeBounds of(IndexRange enough, IndexRange needed) {
    return {{enough.first, std::max(enough.first, enough.last)}, needed};
  }
};

/// The finding about the tubes of one state.
struct TubeFinding {
  Finding finding;
  bool exact = false;  ///< no tube could be smaller
};

/// Compares tubes of the analysis with the verifier's own: one that leaves out a cell that is needed is
/// wrong; one that does not hold all that is enough for the verifier is not confirmed. Safe to use from
/// several threads.
class TubeTally {
 public:
  /// @pre unchecked: what `question` points to outlives this object.
  explicit TubeTally(const PostQuestion& question);

  /// True if the entry holds all that is enough.
  [[nodiscard]] bool is_enough(std::int64_t position, std::int64_t by,
                               const std::vector<TubeBounds>& tubes) const;
  /// @param by how far up the bounds have to be moved
  /// @param tubes one for each piece of the cell; empty: there are no bounds
  void add(std::int64_t position, std::int64_t by, const std::vector<TubeBounds>& tubes);
  /// The entry says that nothing is known, which blocks the pair: no tube need be computed.
  void add_unbounded() { tally_.add_checked(1); }
  [[nodiscard]] bool is_unbounded(std::int64_t position) const;

  [[nodiscard]] TubeFinding finding(bool may_be_exact);

 private:
  [[nodiscard]] bool is_exact(IndexRange claimed, std::int64_t by,
                              const std::vector<TubeBounds>& tubes) const;
  [[nodiscard]] std::string text_of(std::int64_t position, IndexRange needed) const;

  const PostQuestion& question_;
  const GridDimension& dimension_;
  const PostTable& claimed_;
  Tally tally_;
  std::atomic<bool> exact_{true};
};

/// Checks the tubes of a state whose flow is a polynomial in time, from corners of the cells: their extremes
/// in time in rational arithmetic.
/// @returns nothing if the flow is not of this kind for some inputs or parameters
[[nodiscard]] std::optional<TubeFinding> check_corner_tubes(const PostQuestion& question, ThreadTeam& team);

/// Checks the tubes of any other state by bounds of its derivative during steps of the period and of its
/// value in between (range_during_period()); the steps get finer until the tube of the analysis holds what
/// they enclose.
[[nodiscard]] TubeFinding check_outward_tubes(const PostQuestion& question, Budget& budget, ThreadTeam& team);

}  // namespace coordreq
